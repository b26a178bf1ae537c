# What a mesh loses that is made of another layer is told.
mr-make sphere -n 300 --texcoords -o textured.mrs
mr-simplify -t control -n 50 textured.mrs | mr-subdivide -o out.mrs
mr-smooth -t 1 textured.mrs | mr-simplify -n 50 -t mesh -o out.mrs
