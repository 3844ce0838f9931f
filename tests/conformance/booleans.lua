-- Operators, functions and methods are the same Booleans.
local a, b, c = cube(2), cube(2):translate(1, 1, 1), cube(2):translate(0, 0, 1)

for _, form in ipairs{a + b, a | b, union(a, b), union{a, b}, a:union(b), union({a}, b)} do
  assert(form == a + b and form:volume() == 15)
end
for _, form in ipairs{a - b, difference(a, b), difference{a, b}, a:difference(b)} do
  assert(form:volume() == 7)
end
for _, form in ipairs{a * b, a & b, intersection(a, b), intersection{a, b}, a:intersection(b)} do
  assert(form:volume() == 1)
end
for _, form in ipairs{a ~ b, symmetric_difference(a, b), a:symmetric_difference{b}} do
  assert(form:volume() == 14)
end
assert(a - b - c == a - (b + c) and difference(a, b, c) == difference(a, {b, c}))
assert(union{a}:volume() == 8 and union{}:is_empty() and difference(union{}, a):is_empty())
assert((a ~ b ~ c):volume() == symmetric_difference(a, b, c):volume())
assert(a + b * c == a + (b * c)) -- * binds tighter than +

-- Colours travel through Booleans and do not change geometry.
assert((a:color("red") - b:color("blue")):volume() == 7)

-- Long chains are one node.
local chain = cube(100, 10, 1)
for i = 1, 40 do chain = chain - cube(1, 1, 1):translate(2 * i, 5, 0) end
assert(chain:volume() == 1000 - 40 and chain:genus() == 40)
return chain
