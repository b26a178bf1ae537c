// peer_motions -- CGAL's as-rigid-as-possible deformation (spokes and rims); prints its seconds per pose.
// usage: peer_motions IN.off OUT.off STEPS AXIS AX AY AZ DEGREES CX CY CZ; fixed below a fifth of the box along AXIS (x, y, z),
// moved above four fifths: turned in so many equal steps, of ten iterations each; all between is the region of interest.
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_deformation.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

typedef CGAL::Simple_cartesian<double> kernel;
typedef CGAL::Surface_mesh<kernel::Point_3> mesh;
typedef CGAL::Surface_mesh_deformation<mesh, CGAL::Default, CGAL::Default, CGAL::SPOKES_AND_RIMS> deformation;

int
main(int argc, char **argv)
{
	mesh m;

	if (argc != 12 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], m))
		return 1;
	int steps = std::atoi(argv[3]), k = argv[4][0] - 'x';
	Eigen::Vector3d axis(std::atof(argv[5]), std::atof(argv[6]), std::atof(argv[7]));
	Eigen::Vector3d center(std::atof(argv[9]), std::atof(argv[10]), std::atof(argv[11]));
	Eigen::Quaterniond turn(Eigen::AngleAxisd(std::atof(argv[8]) / steps * CGAL_PI / 180, axis));
	double low = 1e300, high = -1e300;
	for (auto v : m.vertices()) {
		low = std::min(low, m.point(v)[k]);
		high = std::max(high, m.point(v)[k]);
	}
	deformation d(m);
	std::vector<mesh::Vertex_index> moved;
	d.insert_roi_vertices(m.vertices().begin(), m.vertices().end());
	for (auto v : m.vertices()) {
		double share = (m.point(v)[k] - low) / (high - low);
		if (share <= 0.2 || share >= 0.8)
			d.insert_control_vertex(v);
		if (share >= 0.8)
			moved.push_back(v);
	}
	if (!d.preprocess())
		return 1;
	auto start = std::chrono::steady_clock::now();
	for (int i = 0; i < steps; i++) {
		d.rotate(moved.begin(), moved.end(), center, turn);
		d.deform(10, 0);
	}
	std::printf("%.5f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / steps);
	return CGAL::IO::write_polygon_mesh(argv[2], m, CGAL::parameters::stream_precision(17)) ? 0 : 1;
}
