local s = ("x"):rep(100) s = s .. ("%5.2f %q %s %d"):format(1.5, "a\n", {}, 3)
local n = 0 for w in ("a b c"):gmatch("%a") do n = n + 1 end
print(s:find("x+"), s:gsub("x", "%0%0"), ("%b()"):rep(3), s:byte(1, -1))
return cube(n)
