// A ring in the middle of a box of 1 x 1: inlet at the inner circle, outlet at the outer.
//   gmsh -2 -format msh41 ring.geo -o ring.msh
r1 = 0.2;
r2 = 0.4;
Point(1) = {0.5, 0.5, 0};
For k In {0:3}
  Point(10 + k) = {0.5 + r1 * Cos(k * Pi / 2), 0.5 + r1 * Sin(k * Pi / 2), 0};
  Point(20 + k) = {0.5 + r2 * Cos(k * Pi / 2), 0.5 + r2 * Sin(k * Pi / 2), 0};
EndFor
For k In {0:3}
  Circle(10 + k) = {10 + k, 1, 10 + (k + 1) % 4};
  Circle(20 + k) = {20 + k, 1, 20 + (k + 1) % 4};
  Line(30 + k) = {10 + k, 20 + k};
EndFor
For k In {0:3}
  Curve Loop(k + 1) = {30 + k, 20 + k, -(30 + (k + 1) % 4), -(10 + k)};
  Plane Surface(k + 1) = {k + 1};
EndFor
Transfinite Curve {10:13, 20:23} = 4;
Transfinite Curve {30:33} = 3;
Transfinite Surface {1:4};
Recombine Surface {1:4};
Physical Curve(0) = {10:13};  // inlet
Physical Curve(1) = {20:23};  // outlet
Physical Surface(1) = {1:4};
