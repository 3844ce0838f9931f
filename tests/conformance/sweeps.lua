-- Solids along a path and between outlines: each option once, with the volume that they must have.
local function near(value, wanted, tolerance)
  assert(math.abs(value - wanted) <= (tolerance or 1e-6) * math.max(1, math.abs(wanted)),
         value .. " instead of " .. wanted)
end

local s = square(2, true)
near(s:sweep{{0, 0, 0}, {0, 0, 10}, {20, 0, 10}}:volume(), 120)
near(sweep(s, {{0, 0, 0}, {0, 0, 10}}):volume(), 40)
near(sweep{s, path = {{0, 0, 0}, {0, 0, 10}}, scale = 0.5}:volume(), (4 + 1 + 2) * 10 / 3)
near(s:sweep({{0, 0, 0}, {0, 0, 10}}, {scale = {1, 0.5}}):volume(), 30)
local frame = s:sweep({{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}}, {closed = true})
near(frame:volume(), 240)
assert(frame:genus() == 1)
assert(s:sweep({{0, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}}, {closed = true, twist = 360}):genus() == 1)
local slat = square(6, 1)
near(slat:sweep({{0, 0, 0}, {0, 0, 10}}, {up = {1, 0, 0}}):size()[2], 6)
local ramp = {}
for i = 0, 64 do ramp[#ramp + 1] = {20 * cos(i * 15), 20 * sin(i * 15), i / 4} end
near(square(6, 1, true):sweep(ramp, {upright = true}):size().z, 17, 0.005)
for _, o in ipairs{{twist = 90}, {twist = 90, fn = 80}, {twist = -200, fn = 30}} do
  local ring = square(4, true) - square(2, true):translate(0.3, 0)
  near(ring:sweep({{0, 0, 0}, {0, 0, 10}}, o):volume(), ring:linear_extrude(10, {twist = -o.twist, fn = o.fn}):volume())
end
assert((square(1) - square(1)):sweep{{0, 0, 0}, {0, 0, 1}}:is_empty())

near(loft({square(10, true), square(4, true)}, {0, 6}):volume(), (100 + 16 + 40) * 2)
near(loft({square(10, true), square(4, true)}, 6):volume(), (100 + 16 + 40) * 2)
near(loft{{square(2), square(2), square(2)}, heights = {1, 2, 5}}:volume(), 16)
assert(loft({circle(5) - circle(3), square(14, true) - square(2, true)}, 5):genus() == 1)

return frame + loft({square(20, true), circle(6)}, {-15, -2})
