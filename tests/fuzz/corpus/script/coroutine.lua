local f = coroutine.wrap(function() for i = 1, 3 do coroutine.yield(cube(i)) end end)
local s = f()
for c in f do s = s + c if c == s then break end end
return s
