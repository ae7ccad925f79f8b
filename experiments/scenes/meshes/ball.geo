// A ball of radius 0.1 m about the origin in tetrahedra of about 0.05 m:  gmsh -3 -format msh41 ball.geo -o ball.msh
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 0.1};
Mesh.CharacteristicLengthMin = 0.05;
Mesh.CharacteristicLengthMax = 0.05;
Mesh.Binary = 0;
