local m = setmetatable({}, {__tostring = function(s) return tostring(s) end})
print(pcall(tostring, m), pcall(error, m))
error(m)
