// The whole box of 1 x 1 with walls at y = 0 and y = 1, in place of the periodic one.
//   gmsh -2 -format msh41 box.geo -o box.msh
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = 5;
Transfinite Surface {1};
Recombine Surface {1};
Physical Curve(0) = {4};      // inlet
Physical Curve(1) = {2};      // outlet
Physical Curve(2) = {1, 3};   // walls
Physical Surface(1) = {1};
