// A window of a U-shaped gasket in a box of 1 x 1: the fluid enters from inside the U,
// along its inner edge, and leaves through the outer one; the two ends are walls.
//   gmsh -2 -format msh41 u_gasket.geo -o u_gasket.msh
ri = 0.15;   // of the bend's inner edge
ro = 0.35;   // of its outer edge
yb = 0.45;   // where the bend begins
yt = 0.9;    // the ends
Point(1) = {0.5, yb, 0};
Point(2) = {0.5 - ro, yt, 0};
Point(3) = {0.5 - ri, yt, 0};
Point(4) = {0.5 - ro, yb, 0};
Point(5) = {0.5 - ri, yb, 0};
Point(6) = {0.5, yb - ro, 0};
Point(7) = {0.5, yb - ri, 0};
Point(8) = {0.5 + ro, yb, 0};
Point(9) = {0.5 + ri, yb, 0};
Point(10) = {0.5 + ro, yt, 0};
Point(11) = {0.5 + ri, yt, 0};
Line(1) = {2, 4};        // outer edge
Circle(2) = {4, 1, 6};
Circle(3) = {6, 1, 8};
Line(4) = {8, 10};
Line(5) = {3, 5};        // inner edge
Circle(6) = {5, 1, 7};
Circle(7) = {7, 1, 9};
Line(8) = {9, 11};
Line(9) = {2, 3};        // from outer to inner
Line(10) = {4, 5};
Line(11) = {6, 7};
Line(12) = {8, 9};
Line(13) = {10, 11};
Curve Loop(1) = {1, 10, -5, -9};
Curve Loop(2) = {2, 11, -6, -10};
Curve Loop(3) = {3, 12, -7, -11};
Curve Loop(4) = {4, 13, -8, -12};
For k In {1:4}
  Plane Surface(k) = {k};
EndFor
Transfinite Curve {1:8} = 4;
Transfinite Curve {9:13} = 3;
Transfinite Surface {1:4};
Recombine Surface {1:4};
Physical Curve(0) = {5:8};    // inlet
Physical Curve(1) = {1:4};    // outlet
Physical Curve(2) = {9, 13};  // walls
Physical Surface(1) = {1:4};
