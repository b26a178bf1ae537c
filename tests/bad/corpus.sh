# Real files that are damaged, odd or empty: each reads as the table says, or is refused with that sentence.
# name|vertices faces, or the sentence behind the file's name
[ -d "$DATA/malformed" ] || { echo 'no $DATA/malformed'; exit 77; }
cat >table <<'X'
assimp_OutOfMemory.off|line 2: 353535235358 vertices and 6 faces cannot be in the 289 bytes that follow
assimp_box_UTF16BE.obj|line 1: '???#?' begins no statement of OBJ
assimp_box_longline.obj|8 790
assimp_box_without_lineending.obj|8 12
assimp_crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply|line 7: '???' is no type of PLY
assimp_cube_binary_header_with_RN_newline.ply|8 12
assimp_cube_binary_starts_with_nl.ply|8 12
assimp_cube_with_vertexcolors.obj|8 12
assimp_empty.obj|the file is empty
assimp_empty.off|the file is empty
assimp_empty.ply|the file is empty
assimp_float-color.ply|3 1
assimp_formatDetection|3 1
assimp_invalid.off|line 7: vertex 20 of 3
assimp_issue623.ply|line 15: a list of length 7.9418
assimp_malformed.obj|line 23: vertex 12 of 8
assimp_malformed2.obj|8 10
assimp_multiple_spaces.obj|4 1 and a remark
assimp_number_formats.obj|line 11: a vertex is '3.1+e2', not a number
assimp_only_a_part_of_vertexcolors.obj|5 3 and a remark
assimp_payload_JVN42386607|line 2: the format's version is not 1.0
assimp_point_cloud.obj|3 0
assimp_regr_3429812.obj|4 4 and a remark
assimp_testline.obj|8 0 and a remark
assimp_testmixed.obj|8 12 and a remark
assimp_triangle_with_empty_solid.stl|3 1
assimp_triangle_with_two_solids.stl|6 2
pdal_bad-geotiff-keys.las|10 0
pdal_bad_vlr_count.las|10 0
pdal_badheader.txt|line 1: column 1 is 'X', not a number
pdal_crlf_test.txt|10 0
pdal_gps-time-nan.las|1 0
pdal_issue_2421.ply|1 0
pdal_missingheader.pcd|10 0
pdal_missingheader.txt|5 0
pdal_no-points.las|las without a vertex
pdal_no_vertex.ply|ply without a vertex
pdal_quoted.txt|9 0
pdal_sized_dims.ply|line 10: element vertex lacks x, y or z
pdal_text_extradim.ply|1 0
pdal_unsized_dims.ply|line 10: element vertex lacks x, y or z
tinyobj_catmark_torus_creases0.obj|32 64 and a remark
tinyobj_colorspace-issue-184.obj|3 1 and a remark
tinyobj_cornell_box.obj|76 36 and a remark
tinyobj_cornell_box_multimaterial.obj|76 36 and a remark
tinyobj_cube-vertex-w-component.obj|8 12 and a remark
tinyobj_cube-vertexcol.obj|8 12 and a remark
tinyobj_cube.obj|8 12 and a remark
tinyobj_invalid-face-definition.obj|none of the 2 faces has three corners
tinyobj_invalid-relative-texture-index.obj|line 2: vertex 1 of 0
tinyobj_invalid-relative-vertex-index.obj|line 1: vertex -4 of 0
tinyobj_issue-138.obj|8 12 and a remark
tinyobj_issue-140-zero-face-idx.obj|line 16: '0/0/0' is not a corner: v, v/vt, v//vn or v/vt/vn, counted from 1
tinyobj_issue-161-inconsistent-f.obj|8 12 and a remark
tinyobj_issue-162-smoothing-group.obj|8 12 and a remark
tinyobj_issue-235-usemtl-then-o.obj|8 2 and a remark
tinyobj_issue-244-mtl-searchpaths.obj|8 2 and a remark
tinyobj_issue-246-usemtl-whitespace.obj|8 1 and a remark
tinyobj_issue-248-texres-texopt.obj|8 12 and a remark
tinyobj_issue-295-trianguation-failure.obj|16 28
tinyobj_issue-319-002.obj|20 14
tinyobj_issue-319-003.obj|10 8
tinyobj_issue-330.obj|7 3
tinyobj_issue-356-leading-spaces-newmtl.obj|obj without a vertex
tinyobj_issue-92.obj|3 1 and a remark
tinyobj_issue-95-2.obj|3 1 and a remark
tinyobj_issue-95.obj|3 1 and a remark
tinyobj_leading-decimal-dot-issue-201.obj|3 1 and a remark
tinyobj_leading-zero-in-exponent-notation-issue-210.obj|3 1 and a remark
tinyobj_line-prim.obj|8 0 and a remark
tinyobj_map-bump.obj|218 400 and a remark
tinyobj_missing_material_file.obj|76 36
tinyobj_mtllib-multiple-files-issue-112.obj|3 1 and a remark
tinyobj_no_material.obj|76 36
tinyobj_norm-texopt.obj|3 1 and a remark
tinyobj_pbr-mat-ext.obj|4 2 and a remark
tinyobj_points-prim.obj|8 0 and a remark
tinyobj_refl.obj|8 12 and a remark
tinyobj_skin-weight.obj|8 12 and a remark
tinyobj_smoothing-group-two-squares.obj|6 3 and a remark
tinyobj_smoothing-normal.obj|8 6 and a remark
tinyobj_test-nan.obj|line 14: a vertex is '1.#IND', not a number
tinyobj_texture-filename-with-whitespace.obj|8 12 and a remark
tinyobj_texture-options-issue-85.obj|3 1 and a remark
tinyobj_tr-and-d-issue-43.obj|218 400 and a remark
tinyobj_usemtl-issue-104.obj|12 6 and a remark
tinyobj_usemtl-issue-68.obj|218 400 and a remark
trimesh_7_8ths_cube.stl|14 24
trimesh_busted.STL|1941 3878
trimesh_comments.off|8 12 and a remark
trimesh_empty.obj|obj without a vertex
trimesh_empty.ply|ply without a vertex
trimesh_empty.stl|stl without a vertex
trimesh_jacked.obj|8 12 and a remark
trimesh_multibody.stl|20 32
trimesh_nancolor.obj|8 12 and a remark
trimesh_negative_indices.obj|8 12
trimesh_obj_empty.obj|obj without a vertex
trimesh_obj_points.obj|8 0
trimesh_obj_wireframe.obj|8 0 and a remark
trimesh_ply_empty_ascii.ply|ply without a vertex
trimesh_ply_empty_bin.ply|ply without a vertex
trimesh_ply_empty_header.ply|ply without a vertex
trimesh_ply_points_ascii.ply|8 0
trimesh_ply_points_bin.ply|8 0
trimesh_points_ascii_with_lists.ply|5 0 and a remark
trimesh_points_emptyascii.ply|12 0 and a remark
trimesh_points_emptyface.ply|1024 0
trimesh_polygonfaces.obj|5 3 and a remark
trimesh_stl_empty_ascii.stl|stl without a vertex
trimesh_stl_empty_bin.stl|stl without a vertex
trimesh_two_objects_mixed_case_names.stl|16 24
trimesh_whitespace.off|8 12 and a remark
X
fail=0
while IFS='|' read -r name verdict; do
	file=$DATA/malformed/$name
	[ -e "$file" ] || { echo "$name is not there"; fail=1; continue; }
	if mr-import --stats stats "$file" >out 2>err; then
		said=$(sed 's/.*"vertices":\([0-9]*\),"triangles":\([0-9]*\).*/\1 \2/' stats)
		[ -s err ] && said="$said and a remark"
	else
		code=$?
		said=$(head -n 1 err | cut -b "$((14 + ${#file}))-")
		[ $code -eq 1 ] && [ "$(wc -l <err)" -eq 1 ] || said="$said (exit $code)"
	fi
	[ "$said" = "$verdict" ] || { echo "$name: '$said', not '$verdict'"; fail=1; }
done <table
[ "$(find "$DATA/malformed" -type f | wc -l)" -eq "$(wc -l <table)" ] || { echo 'a file is not in the table'; fail=1; }
exit $fail
