"""Poisson's surface of a cloud by Open3D: python3 peer_open3d.py POINTS.xyz OUT.ply

Statistical outliers are removed (20 neighbours, 2 deviations), normals estimated (30 neighbours) and oriented
consistently; depth 8, the default.  Prints the seconds without reading and writing.
"""

import sys
import time

import numpy
import open3d


def main(source, target):
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(numpy.loadtxt(source)[:, :3]))
    start = time.perf_counter()
    cloud, _ = cloud.remove_statistical_outlier(20, 2.0)
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(30))
    cloud.orient_normals_consistent_tangent_plane(30)
    mesh, _ = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=8)
    seconds = time.perf_counter() - start
    open3d.io.write_triangle_mesh(target, mesh)
    print(seconds)


main(*sys.argv[1:])
