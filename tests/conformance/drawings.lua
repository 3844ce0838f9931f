-- Text and drawings as shapes: each option once, against areas that are known.
local function near(value, wanted, tolerance)
  assert(math.abs(value - wanted) <= (tolerance or 1e-6) * math.max(1, math.abs(wanted)),
         value .. " instead of " .. wanted)
end
local function polygon_area(n, r) return n / 2 * math.sin(2 * math.pi / n) * r * r end

-- The bar of an I is 191 x 1409 units of 2048 to an em, and an em is size / 0.72.
local unit = 10 / 0.72 / 2048
near(text("I"):area(), 191 * 1409 * unit ^ 2)
near(text("I", 20):area(), 4 * 191 * 1409 * unit ^ 2)
near(text("I", {em = 2048}):area(), 191 * 1409)
near(text{"I", size = 5, font = "Liberation Sans:style=Bold"}:bbox().max[2], 1409 * unit / 2)
assert(text("I", 10, "liberation sans") == text("I"))
local width = text_metrics("abc").advance[1]
near(text_metrics("abc", {spacing = 2}).advance[1], 2 * width)
near(text_metrics("abc", {halign = "center"}).offset[1], -width / 2)
near(text_metrics("abc", {halign = "right"}).offset[1], -width)
near(text("Iy", {valign = "top"}):bbox().max[2], 0)
near(text("Iy", {valign = "bottom"}):bbox().min[2], 0)
near(text_metrics("Iy", {valign = "center"}).position[2] * 2, -text_metrics("Iy").size[2])
assert(textmetrics("Iy").descent < 0 and text_metrics("Iy").ascent > 0)
assert(text("abc", {direction = "rtl", language = "ar", script = "latin"}) ~= text("abc"))
assert(#text("O", {fn = 64}):points() > 2 * #text("O", {fn = 8}):points())

local plate = import("drawings/plate.svg", {fn = 32})
near(plate:area(), 800 - polygon_area(32, 3))
near(import("drawings/plate.svg", {layer = "plate", fn = 16}):area(), 800 - polygon_area(16, 3))
near(import{"drawings/plate.svg", id = "slot", fn = 16}:area(), 11 * 4 + polygon_area(16, 2))
near(import("drawings/plate.svg", {layer = "slot", fa = 90, fs = 0.1}):area(), 11 * 4 + polygon_area(8, 2), 0.2)
near(import("drawings/plate.svg", {center = true}):bbox().min[1], -20)
near(import("drawings/plate.svg", {dpi = 300}):bbox().max[1], 40) -- the file has a size

-- Points of a DXF go to the nearest 1/1024.
local function area_on_grid(n, r)
  local function place(c) return math.floor(c * r * 1024 + 0.5) / 1024 end
  local sum = 0
  for i = 0, n - 1 do
    local a, b = 2 * math.pi * i / n, 2 * math.pi * (i + 1) / n
    sum = sum + place(math.cos(a)) * place(math.sin(b)) - place(math.sin(a)) * place(math.cos(b))
  end
  return sum / 2
end
near(import("drawings/plate.dxf"):area(), 200 - circle(2):area(), 1e-5)
near(import("drawings/plate.dxf", {layer = "hole", fn = 12}):area(), area_on_grid(12, 2))
near(import("drawings/plate.dxf", {scale = 2}):bbox().max[1], 40)
near(import("drawings/plate.dxf", {origin = {10, 5}}):bbox().min[2], -5)

return (plate - text("ab", {size = 4}):translate(15, 1)):linear_extrude(2)
