// A beam of 1 x 0.25 x 0.25 m in tetrahedra of about 0.075 m:  gmsh -3 -format msh41 beam.geo -o beam.msh
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 0.25, 0.25};
Mesh.CharacteristicLengthMin = 0.083;
Mesh.CharacteristicLengthMax = 0.083;
Mesh.Binary = 0;
