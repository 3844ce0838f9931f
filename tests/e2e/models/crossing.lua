-- Bars that cross at unrelated angles, far from the origin: faces thinner than a 32-bit float can tell
-- apart, and corners that only exact numbers keep in order.
local bars = {}
for i = 1, 9 do
  bars[i] = cube{30, 2, 2, center = true}:rotate(7 * i, 11.3 * i, 3.7 * i)
end
local star = union(bars)
local shell = star - star:scale(0.995)
return {
  star = star:translate(1000, -700, 300),
  shell = (shell - cube(40):translate(-20, -20, 0)):translate(0, 0, -200),
}
