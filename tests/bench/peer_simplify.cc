// peer_simplify -- CGAL's edge_collapse; usage: peer_simplify IN.off OUT.off FACES gh|lt; prints its seconds.
// gh: Garland and Heckbert's costs and placements; lt: Lindstrom and Turk's, which are CGAL's defaults.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

typedef CGAL::Exact_predicates_inexact_constructions_kernel kernel;
typedef CGAL::Surface_mesh<kernel::Point_3> mesh;
namespace SMS = CGAL::Surface_mesh_simplification;

static void
garland_heckbert(mesh &m, const SMS::Count_stop_predicate<mesh> &stop)
{
	typedef SMS::GarlandHeckbert_policies<mesh, kernel> policies;
	policies gh(m);

	SMS::edge_collapse(m, stop,
	    CGAL::parameters::get_cost(gh.get_cost())
	        .get_placement(SMS::Bounded_normal_change_placement<policies::Get_placement>(gh.get_placement())));
}

int
main(int argc, char **argv)
{
	mesh m;

	if (argc != 5 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], m))
		return 1;
	// On a closed mesh two faces go with three edges.
	SMS::Count_stop_predicate<mesh> stop(std::strtoul(argv[3], NULL, 10) * 3 / 2 + 1);
	auto start = std::chrono::steady_clock::now();
	if (!std::strcmp(argv[4], "gh"))
		garland_heckbert(m, stop);
	else
		SMS::edge_collapse(m, stop);
	std::printf("%.4f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
	m.collect_garbage();
	return CGAL::IO::write_polygon_mesh(argv[2], m, CGAL::parameters::stream_precision(17)) ? 0 : 1;
}
