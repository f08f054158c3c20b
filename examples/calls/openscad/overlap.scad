// A mesh that passes through itself, as an import gives it: two tetrahedra in one polyhedron, one tip in the other.
// openscad -o in.stl overlap.scad; unsnarl fix in.stl -o out.stl
polyhedron(points = [[0,0,0],[4,0,0],[0,4,0],[0,0,4],[1.2,1.2,1.1],[2.6,2.5,2],[2.5,2.6,2.2],[2.4,2.4,2.7]],
           faces = [[0,2,1],[0,1,3],[1,2,3],[0,3,2],[4,6,5],[4,5,7],[5,6,7],[4,7,6]]);
