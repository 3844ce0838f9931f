local s = polyhedron{points = {{0,0,0},{2,0,0},{0,2,0},{0,0,2}}, faces = {{0,1,2},{0,3,1},{0,2,3},{1,3,2}}}
return outer_hull(s + s:translate(0.5, 0.5, 0.5), {orientation_sensitive = true, keep_voids = true})
