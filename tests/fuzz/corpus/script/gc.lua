print(pcall(setmetatable, {}, {__gc = print}), collectgarbage(), collectgarbage("count"))
return cube(1)
