local x = math.tointeger(2^53) // 7 % 5 << 3 ~ 1
print(math.maxinteger + 1 == math.mininteger, math.random(1, 6), math.fmod(7, 3), 7 // 0.0, -7 % math.huge)
return cube(math.abs(x) + 1)
