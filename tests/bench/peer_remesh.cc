// peer_remesh -- CGAL's isotropic_remeshing; usage: peer_remesh IN.off OUT.off LENGTH ROUNDS; prints its seconds.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

int
main(int argc, char **argv)
{
	typedef CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> mesh;
	namespace PMP = CGAL::Polygon_mesh_processing;
	mesh m;

	if (argc != 5 || !PMP::IO::read_polygon_mesh(argv[1], m))
		return 1;
	auto start = std::chrono::steady_clock::now();
	PMP::isotropic_remeshing(
	    faces(m), std::strtod(argv[3], NULL), m, PMP::parameters::number_of_iterations(unsigned(std::strtoul(argv[4], NULL, 10))));
	std::printf("%.4f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
	m.collect_garbage();
	return CGAL::IO::write_polygon_mesh(argv[2], m, CGAL::parameters::stream_precision(17)) ? 0 : 1;
}
