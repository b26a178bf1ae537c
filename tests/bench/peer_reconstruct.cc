// peer_reconstruct -- CGAL's surfaces from points; usage: peer_reconstruct poisson|front IN.xyz OUT.off; prints seconds,
// normals of 18 neighbours and their orientation along a minimum spanning tree included where the method wants them.
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/read_points.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/mst_orient_normals.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/poisson_surface_reconstruction.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <vector>

typedef CGAL::Exact_predicates_inexact_constructions_kernel kernel;
typedef std::pair<kernel::Point_3, kernel::Vector_3> oriented;
typedef CGAL::First_of_pair_property_map<oriented> point_of;
typedef CGAL::Second_of_pair_property_map<oriented> normal_of;

static bool
poisson(std::vector<oriented> &points, const char *path)
{
	CGAL::Polyhedron_3<kernel> out;
	auto maps = CGAL::parameters::point_map(point_of()).normal_map(normal_of());

	CGAL::pca_estimate_normals<CGAL::Sequential_tag>(points, 18, maps);
	points.erase(CGAL::mst_orient_normals(points, 18, maps), points.end());
	double spacing = CGAL::compute_average_spacing<CGAL::Sequential_tag>(points, 6, CGAL::parameters::point_map(point_of()));
	if (!CGAL::poisson_surface_reconstruction_delaunay(
		points.begin(), points.end(), point_of(), normal_of(), out, spacing))
		return false;
	std::ofstream file(path);
	file.precision(17);
	return bool(file << out);
}

static bool
front(const std::vector<oriented> &points, const char *path)
{
	std::vector<kernel::Point_3> p;
	std::vector<std::array<std::size_t, 3>> faces;

	for (const auto &o : points)
		p.push_back(o.first);
	CGAL::advancing_front_surface_reconstruction(p.begin(), p.end(), std::back_inserter(faces));
	std::ofstream file(path);
	file.precision(17);
	file << "OFF\n" << p.size() << ' ' << faces.size() << " 0\n";
	for (const auto &q : p)
		file << q << '\n';
	for (const auto &f : faces)
		file << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
	return bool(file);
}

int
main(int argc, char **argv)
{
	std::vector<oriented> points;

	if (argc != 4 || !CGAL::IO::read_points(argv[2], std::back_inserter(points), CGAL::parameters::point_map(point_of())))
		return 1;
	auto start = std::chrono::steady_clock::now();
	if (!(std::strcmp(argv[1], "front") ? poisson(points, argv[3]) : front(points, argv[3])))
		return 1;
	std::printf("%.4f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}
