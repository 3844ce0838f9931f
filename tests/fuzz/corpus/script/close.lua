local c <close> = setmetatable({}, {__close = function() error("closing") end})
local k <const> = 5
return cube(k)
