// peer_subdivide -- OpenMesh's Loop subdivision; usage: peer_subdivide IN.off LEVEL; prints its seconds.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <chrono>
#include <cstdio>
#include <cstdlib>

struct traits : OpenMesh::DefaultTraits {
	typedef OpenMesh::Vec3d Point;
	typedef OpenMesh::Vec3d Normal;
};

int
main(int argc, char **argv)
{
	typedef OpenMesh::TriMesh_ArrayKernelT<traits> mesh;
	OpenMesh::Subdivider::Uniform::LoopT<mesh, double> loop;
	mesh m;

	if (argc != 3 || !OpenMesh::IO::read_mesh(m, argv[1]))
		return 1;
	auto start = std::chrono::steady_clock::now();
	loop.attach(m);
	loop(std::strtoul(argv[2], NULL, 10));
	loop.detach();
	std::printf("%.4f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
	return m.n_faces() > 0 ? 0 : 1;
}
