# Dialects of tables: separators, names with blanks, empty cells, PTS without a count.
try() {
	printf "$@" | mr-import 2>said | mr-export -q -f ply-ascii - | sed '/^ply/d; /^format/d; /^end/d' | tr '\n' ' ' | sed 's/property //g'
	echo
	cat said
}
echo '-- names with blanks, and every separator'
try '//X;Y;Z;Rf;Gf;Bf;Point density (r=0.01);Nx;Ny;Nz\n2\n0;0;0;1;0.5;0;12;0;0;1\n1;0;0;0;0;1;13;0;1;0\n'
try '//X,Y,Z,Scalar field,Nx,Ny,Nz\n0,0,0,.5,0,0,1\n'
try '# X\tY\tZ\tScalar field\tNx\tNy\tNz\n0\t0\t0\t.5\t0\t0\t1\n'
try '"X" ; "Y" ; "Z" ; "Scalar; field" ;\n0 ; 0 ; 0 ; 3 ;\n'
try 'x y z intensity\n0 0 0 0.5\n'
echo '-- an empty cell, also the last, is no number'
try 'x,y,z,a,b\n1,2,3,,5\n1,2,4,6,\n'
try '1;2;3;4\n1;2;3; \n'
echo '-- seven columns: the intensity is less like the colours'
for count in '' '3\n'; do
	try "${count}0 0 0 0 117 130 149\n1 0 0 0 130 137 153\n2 0 0 11 126 135 150\n"
done
try '0 0 0 117 130 149 1\n1 0 0 130 137 153 2\n2 0 0 126 135 150 2\n'
