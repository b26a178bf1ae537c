/* The table of formats: how each is recognised, read and written, and what it keeps. */
#include "formats/formats.h"
#include "base/utf8.h"
#include "formats/filename.h"
#include "formats/format.h"
#include "mesh/name_lists.h"
#include "stream/record.h"

#include <unistd.h>

/* In the order of sniffing: what has a signature first, plain columns of numbers last. */
static const mr_file_format formats[] = {
	{ "glb", true, "glTF", NULL, mr_gltf_read, mr_glb_write, mr_glb_write_scene },
	{ "gltf", false, "{", NULL, mr_gltf_read, mr_gltf_write, mr_gltf_write_scene },
	{ "ply", true, "ply\n|ply\r|ply ", NULL, mr_ply_read, mr_ply_write, NULL },
	{ "ply-ascii", false, NULL, NULL, mr_ply_read, mr_ply_write_ascii, NULL },
	{ "ply-float", true, NULL, NULL, mr_ply_read, mr_ply_write_float, NULL },
	{ "las", true, "LASF", NULL, mr_las_read, NULL, NULL },
	{ "stl", true, NULL, mr_stl_sniff, mr_stl_read, mr_stl_write, NULL },
	{ "stl-ascii", false, NULL, NULL, mr_stl_read, mr_stl_write_ascii, NULL },
	{ "off", false, NULL, mr_off_sniff, mr_off_read, mr_off_write, NULL },
	{ "pcd", true, "# .PCD|VERSION|FIELDS", NULL, mr_pcd_read, NULL, NULL },
	{ "obj", false, NULL, mr_obj_sniff, mr_obj_read, mr_obj_write, NULL },
	{ "ptx", false, NULL, mr_ptx_sniff, mr_ptx_read, NULL, NULL },
	{ "xyz", false, NULL, mr_xyz_sniff, mr_xyz_read, mr_xyz_write, NULL },
	{ "pts", false, NULL, NULL, mr_xyz_read, mr_pts_write, NULL },
	{ "pwn", false, NULL, NULL, mr_xyz_read, mr_pwn_write, NULL },
};

enum { FORMATS = sizeof formats / sizeof *formats };

void
mr_tell(mr_ctx *ctx, mr_finding_kind kind, size_t count, const char *format, ...)
{
	char what[MR_ERROR_MAX];
	va_list args;

	if (count == 0)
		return;
	va_start(args, format);
	vsnprintf(what, sizeof what, format, args);
	va_end(args);
	mr_found(ctx, &(mr_finding){ .kind = kind, .what = what, .count = count });
}

/* ---- names ---- */

static const mr_file_format *
by_name(const char *name)
{
	for (size_t i = 0; i < FORMATS; i++)
		if (!strcmp(formats[i].name, name))
			return &formats[i];
	return NULL;
}

static const mr_file_format *
by_suffix(const char *path)
{
	const char *name = mr_suffix_format(path);

	return name ? by_name(name) : NULL;
}

/* With commas between: those that can be written, or all that can be read. */
static const char *
names_of_formats(mr_ctx *ctx, bool writable)
{
	const char *names = "";

	for (size_t i = 0; i < FORMATS; i++)
		if (!writable || formats[i].write)
			names = mr_format(ctx, "%s%s%s", names, *names ? ", " : "", formats[i].name);
	return names;
}

static mr_status
find_writer(mr_ctx *ctx, const char *path, const char *format, const mr_file_format **f)
{
	const mr_file_format *found = format ? by_name(format) : by_suffix(path);
	const char *names = names_of_formats(ctx, true);

	if (format && !found)
		return mr_fail(ctx, MR_EUSAGE, "unknown format '%s'; there are %s", format, names);
	if (!found)
		return mr_fail(ctx, MR_EUSAGE, "%s: its name tells no format; -f does: %s", path, names);
	if (!found->write)
		return mr_fail(
		    ctx, MR_EUSAGE, "%s is only read, not written; there are %s", found->name, names);
	if (!strcmp(path, "-") && !strcmp(found->name, "gltf"))
		return mr_fail(
		    ctx, MR_EUSAGE, "gltf is several files, of which stdout holds none: -f glb is one");
	*f = found;
	return MR_OK;
}

mr_status
mr_format_check(mr_ctx *ctx, const char *path, const char *format, bool writable, bool *binary)
{
	const mr_file_format *f = format ? by_name(format) : NULL;

	if (writable)
		MR_TRY(find_writer(ctx, path, format, &f));
	else if (format && !f) {
		return mr_fail(ctx, MR_EUSAGE, "unknown format '%s'; there are %s", format,
		    names_of_formats(ctx, false));
	}
	*binary = f && (f->binary || mr_suffix_gz(path));
	return MR_OK;
}

const char *
mr_format_stem(mr_ctx *ctx, const char *path)
{
	const char *file = mr_file_name(path);
	size_t bytes = strlen(file) - (mr_suffix_gz(file) ? 3 : 0);
	char *name;

	if (!strcmp(path, "-"))
		return "stdin";
	for (size_t i = bytes; i > 1; i--)
		if (file[i - 1] == '.') {
			bytes = i - 1;
			break;
		}
	name = mr_alloc(ctx, bytes + 1, 1);
	if (mr_clean_name(name, file, bytes, true) == 0 || !strcmp(name, ".") || !strcmp(name, ".."))
		return "model"; /* no frame can be called so */
	return name;
}

/* ---- reading ---- */

void
mr_skip_mark(const unsigned char **data, size_t *size)
{
	if (*size > 3 && !mr_stl_is_binary(*data, *size) && !memcmp(*data, "\xef\xbb\xbf", 3)) {
		*data += 3;
		*size -= 3;
	}
}

/* Whether the bytes are of the format. */
static bool
knows(const mr_file_format *f, const unsigned char *data, size_t size)
{
	mr_scan text = mr_scan_of(NULL, data, size);

	if (!f->magic)
		return f->sniff && f->sniff(data, size);
	mr_skip_space(&text);
	for (const char *m = f->magic; *m; m += *m == '|') {
		size_t n = strcspn(m, "|");
		if (n <= (size_t)(text.end - text.p) && !memcmp(text.p, m, n))
			return true;
		m += n;
	}
	return false;
}

static mr_status
find_reader(mr_ctx *ctx, const char *path, const char *format, const unsigned char *data, size_t size,
    const mr_file_format **f)
{
	const char *names = names_of_formats(ctx, false);
	const mr_file_format *found = format ? by_name(format) : NULL;

	if (format && !found)
		return mr_fail(ctx, MR_EUSAGE, "unknown format '%s'; there are %s", format, names);
	if (size == 0)
		return mr_fail(ctx, MR_EFORMAT, "the file is empty");
	for (size_t i = 0; i < FORMATS && !found; i++)
		if (knows(&formats[i], data, size))
			found = &formats[i];
	if (!found)
		found = by_suffix(path); /* whose reader reports the error */
	if (!found && size >= MR_MAGIC_BYTES && !memcmp(data, MR_MAGIC, MR_MAGIC_BYTES))
		return mr_fail(ctx, MR_EFORMAT, "this is a stream already, for the tools behind mr-import");
	if (!found)
		return mr_fail(
		    ctx, MR_EFORMAT, "no format is recognised in its bytes; -f names one of %s", names);
	*f = found;
	return MR_OK;
}

/* Vertices without a place stand where one is that has one. */
static mr_status
find_places(mr_ctx *ctx, mr_model *m)
{
	size_t at = 0;
	bool *placed;
	mr_v3 *p;

	if (mr_first_infinite((const double *)m->p, 3 * m->nv) == 3 * m->nv)
		return MR_OK;
	while (at < m->nv && !mr_finite(m->p[at]))
		at++;
	if (at == m->nv)
		return mr_fail(ctx, MR_EMESH, "none of %zu points has a place", m->nv);
	m->placed = placed = MR_NEW(ctx, m->nv, bool);
	p = MR_NEW(ctx, m->nv, mr_v3);
	for (size_t i = 0; i < m->nv; i++) {
		placed[i] = mr_finite(m->p[i]);
		p[i] = m->p[placed[i] ? i : at];
	}
	m->p = p;
	return MR_OK;
}

/* A surface gets the normals that are none from its faces. */
static void
mend_normals(mr_ctx *ctx, mr_model *m)
{
	const mr_mesh mesh = { .name = "mesh", .p = m->p, .t = m->t, .nv = m->nv, .nf = m->nf };
	size_t none = 0;
	mr_v3 *normal;

	for (size_t i = 0; m->nf && m->normal && i < m->nv; i++)
		none += mr_norm2(m->normal[i]) > 0 ? 0 : 1;
	if (none == 0)
		return;
	normal = MR_NEW(ctx, m->nv, mr_v3);
	mr_vertex_normals(&mesh, normal);
	for (size_t i = 0; i < m->nv; i++)
		if (mr_norm2(m->normal[i]) > 0)
			normal[i] = m->normal[i];
	m->normal = normal;
}

static mr_status
parse(mr_ctx *ctx, const char *path, const char *format, const unsigned char *data, size_t size, mr_model *m)
{
	const mr_file_format *f = NULL;
	mr_model got = { .path = path };

	mr_skip_mark(&data, &size);
	MR_TRY(find_reader(ctx, path, format, data, size, &f));
	MR_TRY(f->read(ctx, data, size, &got));
	if (got.nv == 0)
		return mr_fail(ctx, MR_EMESH, "%s without a vertex", f->name);
	MR_TRY(find_places(ctx, &got));
	mend_normals(ctx, &got);
	mr_note(ctx, "%s: %zu vertices, %zu triangles", f->name, got.nv, got.nf);
	*m = got;
	return MR_OK;
}

mr_status
mr_model_parse(
    mr_ctx *ctx, const char *path, const char *format, const unsigned char *data, size_t size, mr_model *m)
{
	MR_ENTER(ctx);
	return parse(ctx, path, format, data, size, m);
}

mr_status
mr_model_read(mr_ctx *ctx, const char *path, const char *format, mr_model *m)
{
	mr_file_bytes bytes = { 0 };
	mr_status status;

	MR_TRY(mr_file_bytes_read(ctx, path, &bytes));
	status = mr_model_parse(ctx, path, format, bytes.data, bytes.size, m);
	status = mr_file_bytes_end(&bytes, status);
	if (status == MR_EUSAGE)
		return status;
	return mr_prefix(ctx, status, "%s", strcmp(path, "-") ? path : "stdin");
}

/* ---- writing ---- */

static mr_status
write_into(mr_sink *s, const mr_file_format *f, const mr_model *m, const mr_scene *scene)
{
	MR_ENTER(s->ctx);
	return scene ? f->write_scene(s, scene) : f->write(s, m);
}

/* Writes the model, or the scene. */
static mr_status
write_file(mr_ctx *ctx, const char *path, const mr_file_format *f, const mr_model *m, const mr_scene *scene,
    mr_outfile *held)
{
	mr_sink sink;

	MR_TRY(mr_sink_open(ctx, path, mr_suffix_gz(path), &sink));
	sink.hold = held != NULL;
	MR_TRY(mr_sink_close(&sink, write_into(&sink, f, m, scene)));
	if (held)
		*held = sink.file;
	return MR_OK;
}

mr_status
mr_model_write(mr_ctx *ctx, const char *path, const char *format, const mr_model *m, mr_outfile *held)
{
	const mr_file_format *f = NULL;

	MR_TRY(find_writer(ctx, path, format, &f));
	if (m->nv == 0)
		return mr_fail(ctx, MR_EMESH, "a layer without a vertex cannot be written as %s", f->name);
	return write_file(ctx, path, f, m, NULL, held);
}

bool
mr_scene_suits(const char *path, const char *format)
{
	const mr_file_format *f = format ? by_name(format) : by_suffix(path);

	return f && f->write_scene;
}

mr_status
mr_scene_write(mr_ctx *ctx, const char *path, const char *format, const mr_scene *scene, mr_outfile *held)
{
	const mr_file_format *f = NULL;

	MR_TRY(find_writer(ctx, path, format, &f));
	return write_file(ctx, path, f, NULL, scene, held);
}

void
mr_put_reals(mr_sink *s, const double *x, size_t n, char end)
{
	char *to = mr_sink_room(s);

	for (size_t i = 0; i < n; i++) {
		to = mr_real_write(to, x[i]);
		*to++ = i + 1 < n ? ' ' : end;
	}
	mr_sink_fill(s, to);
}

void
mr_faces_of(mr_sink *s, const mr_model *m, mr_polygons *faces)
{
	mr_polygons_find(s->ctx, m->t, m->nf, m->polygon, faces);
	mr_lost(s->ctx, NULL, faces->broken, "polygons that are none any more");
}

void
mr_coarse(mr_ctx *ctx, size_t count, size_t n, double share)
{
	char what[64];

	snprintf(what, sizeof what, "positions (up to %.1g of the diagonal)", share);
	mr_found(
	    ctx, &(mr_finding){ .kind = MR_ROUNDED, .what = what, .count = count, .of = n, .value = share });
}

mr_status
mr_note_rounded(mr_sink *s, const mr_model *m)
{
	const double share =
	    1e-7; /* of the diagonal: about what a float is off of a model about the origin */
	const mr_box box = mr_mesh_box(&(mr_mesh){ .p = m->p, .nv = m->nv, .t = m->t, .nf = m->nf });
	mr_v3 far = { 0, 0, 0 }, across = mr_sub(box.max, box.min);
	double off, diagonal = hypot(hypot(across.x, across.y), across.z); /* 1e-300 has no square */
	size_t changed = 0;

	for (size_t i = 0; i < m->nv; i++) {
		mr_v3 p = m->p[i], q = { mr_as_float(p.x), mr_as_float(p.y), mr_as_float(p.z) };
		if (!mr_finite(q))
			return mr_fail(s->ctx, MR_ERANGE, "position %zu (%g %g %g) is too large for float32",
			    i, p.x, p.y, p.z);
		changed += q.x != p.x || q.y != p.y || q.z != p.z;
		far = mr_vec(
		    fmax(far.x, fabs(p.x - q.x)), fmax(far.y, fabs(p.y - q.y)), fmax(far.z, fabs(p.z - q.z)));
	}
	off = hypot(hypot(far.x, far.y), far.z);
	if (diagonal > 0 && off > share * diagonal) /* a single place is as near as floats are */
		mr_coarse(s->ctx, changed, m->nv, off / diagonal);
	return MR_OK;
}
