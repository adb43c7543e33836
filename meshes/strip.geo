// A straight strip across a box of 1 x 1: inlet at x = 0, outlet at x = 1.
//   gmsh -2 -format msh41 strip.geo -o strip.msh
Point(1) = {0, 0.25, 0};
Point(2) = {1, 0.25, 0};
Point(3) = {1, 0.75, 0};
Point(4) = {0, 0.75, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 5;
Transfinite Curve {2, 4} = 3;
Transfinite Surface {1};
Recombine Surface {1};
Physical Curve(0) = {4};      // inlet
Physical Curve(1) = {2};      // outlet
Physical Curve(2) = {1, 3};   // walls
Physical Surface(1) = {1};
