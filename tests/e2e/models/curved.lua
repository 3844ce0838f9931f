-- Curved surfaces cut by curved surfaces: rings of facets, twisted and turned profiles, a knurl.
local torus = circle(3, {fn = 24}):translate(12, 0):rotate_extrude{fn = 48}
local screw = (circle(4, {fn = 24}) - square(1, 20)):linear_extrude(20, {twist = 270, slices = 30})
local ring = circle(6, {fn = 24}) - circle(5, {fn = 24})
local bend = ring:translate(10, 0):rotate_extrude{angle = 100, fn = 40}
local vase = polygon{{0, 0}, {8, 0}, {5, 10}, {7, 20}, {0, 20}}:rotate_extrude{fn = 30}

local knob = cylinder{h = 10, r = 8, fn = 48}
for i = 0, 11 do
  knob = knob - cylinder{h = 10, r = 1, fn = 12}:translate(8.2, 0, 0):rotate(30 * i + 5)
end

return {
  torus = torus - torus:rotate(90, 0, 0),
  screw = (screw - sphere(3, {fn = 20}):translate(4, 0, 10)):translate(0, 40, 0),
  bend = (bend * cube{30, 30, 8, center = true}):translate(0, -40, 0),
  vase = (vase - vase:scale(0.8):translate(0, 0, 4)):translate(40, 0, 0),
  knob = knob:translate(-40, 0, 0),
}
