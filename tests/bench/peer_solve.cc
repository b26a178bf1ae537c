// The thin plate by Eigen: its own Cholesky, and CHOLMOD's supernodal one as Eigen calls it.
// usage: peer_solve FILE.off LOW HIGH; fixed below LOW and above HIGH of the box along x; prints per solver
// NAME, seconds to assemble, to factor, and to solve for three right-hand sides.
#include <Eigen/CholmodSupport>
#include <Eigen/Geometry>
#include <Eigen/Sparse>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::Vector3d;

static double
seconds()
{
	return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

static std::vector<Vector> position;
static std::vector<std::array<int, 3>> face;

static bool
read_off(const char *path)
{
	size_t nv, nf, ne;
	FILE *file = fopen(path, "r");
	if (!file || fscanf(file, "OFF %zu %zu %zu", &nv, &nf, &ne) != 3)
		return false;
	position.resize(nv);
	face.resize(nf);
	for (auto &p : position)
		if (fscanf(file, "%lf %lf %lf", &p[0], &p[1], &p[2]) != 3)
			return false;
	for (auto &f : face)
		if (fscanf(file, "%*d %d %d %d", &f[0], &f[1], &f[2]) != 3)
			return false;
	fclose(file);
	return true;
}

// L and 1 / mixed Voronoi area, of acute triangles (the benchmark's are).
static void
laplacian(Matrix &l, Eigen::VectorXd &w)
{
	std::vector<Eigen::Triplet<double>> entries;
	Eigen::VectorXd area = Eigen::VectorXd::Zero(position.size());
	for (const auto &f : face)
		for (int k = 0; k < 3; k++) {
			int i = f[k], j = f[(k + 1) % 3];
			Vector c = position[f[(k + 2) % 3]], a = position[i] - c, b = position[j] - c;
			double cot = a.dot(b) / a.cross(b).norm(), part = cot * (a - b).squaredNorm() / 8;
			entries.insert(entries.end(), { { i, j, -cot / 2 }, { j, i, -cot / 2 }, { i, i, cot / 2 },
							  { j, j, cot / 2 } });
			area[i] += part;
			area[j] += part;
		}
	l.resize(position.size(), position.size());
	l.setFromTriplets(entries.begin(), entries.end());
	w = area.mean() * area.cwiseInverse();
}

static Matrix
thin_plate(double low, double high)
{
	Matrix l, s;
	Eigen::VectorXd w;
	std::vector<Eigen::Triplet<double>> pick;
	double min = position[0][0], max = min;
	for (const auto &p : position) {
		min = std::min(min, p[0]);
		max = std::max(max, p[0]);
	}
	int n = 0;
	for (size_t v = 0; v < position.size(); v++) {
		double x = (position[v][0] - min) / (max - min);
		if (x >= low && x <= high)
			pick.push_back({ (int)v, n++, 1.0 });
	}
	laplacian(l, w);
	s.resize(position.size(), n);
	s.setFromTriplets(pick.begin(), pick.end());
	Matrix lf = l * s;
	return Matrix(lf.transpose() * w.asDiagonal() * lf);
}

template <class Solver>
static void
measure(const char *name, double low, double high)
{
	double t0 = seconds();
	Matrix a = thin_plate(low, high);
	double t1 = seconds();
	Solver solver;
	solver.compute(a);
	double t2 = seconds();
	Eigen::MatrixXd x = solver.solve(Eigen::MatrixXd::Ones(a.rows(), 3));
	double t3 = seconds();
	printf("%s %.4f %.4f %.4f\n", name, t1 - t0, t2 - t1, t3 - t2);
}

int
main(int argc, char **argv)
{
	if (argc != 4 || !read_off(argv[1]))
		return 1;
	measure<Eigen::SimplicialLLT<Matrix>>("eigen", atof(argv[2]), atof(argv[3]));
	measure<Eigen::CholmodSupernodalLLT<Matrix>>("eigen+cholmod", atof(argv[2]), atof(argv[3]));
}
