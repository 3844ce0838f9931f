local p = string.pack("<i4d", 1, 2.5) print(string.unpack("<i4d", p), utf8.char(8364), utf8.len("€"))
return cube(1)
