"""Poisson's surface of a cloud by Open3D: python3 peer_open3d.py [options] POINTS.xyz OUT.ply

Statistical outliers are removed (20 neighbours, 2 deviations), normals estimated (30 neighbours) and oriented
consistently.  Prints the seconds without reading and writing.  OMP_NUM_THREADS is for all of it.
"""

import argparse
import os
import time

import numpy
import open3d


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--depth", type=int, default=8)
    parser.add_argument("--normals", action="store_true", help="those of the file, its columns 4 to 6")
    parser.add_argument("--clean", action="store_true", help="no outliers; the surface ends 6 spacings from points")
    parser.add_argument("points")
    parser.add_argument("out")
    options = parser.parse_args()
    columns = numpy.loadtxt(options.points)
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(columns[:, :3]))
    start = time.perf_counter()
    if options.normals:
        cloud.normals = open3d.utility.Vector3dVector(columns[:, 3:6])
    if not options.clean:
        cloud, _ = cloud.remove_statistical_outlier(20, 2.0)
    if not options.normals:
        cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(30))
        cloud.orient_normals_consistent_tangent_plane(30)
    threads = int(os.environ.get("OMP_NUM_THREADS", -1))
    poisson = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson
    mesh, _ = poisson(cloud, depth=options.depth, n_threads=threads)
    if options.clean:
        distance = open3d.geometry.PointCloud(mesh.vertices).compute_point_cloud_distance(cloud)
        spacing = numpy.median(numpy.asarray(cloud.compute_nearest_neighbor_distance()))
        mesh.remove_vertices_by_mask(numpy.asarray(distance) > 6 * spacing)
    seconds = time.perf_counter() - start
    open3d.io.write_triangle_mesh(options.out, mesh)
    print(seconds)


main()
