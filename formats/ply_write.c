/* Stanford PLY, written: positions, normals and texture coordinates as doubles, so that nothing is rounded.
 */
#include "formats/format.h"

typedef enum order { ASCII, LITTLE, BIG } order;

static void
put_header(mr_sink *s, const mr_model *m, order o)
{
	static const char *const names[] = { "ascii", "binary_little_endian", "binary_big_endian" };
	const char *p = m->groups.text, *end = p + m->groups.bytes;

	mr_print(s, "ply\nformat %s 1.0\n", names[o]);
	while (m->group && p <= end) {
		const char *e = p < end ? memchr(p, '\n', (size_t)(end - p)) : NULL;
		mr_put(s, "comment group ", 14);
		mr_put(s, p, (size_t)((e ? e : end) - p));
		mr_put(s, "\n", 1);
		p = e ? e + 1 : end + 1;
	}
	mr_print(s, "element vertex %zu\nproperty double x\nproperty double y\nproperty double z\n", m->nv);
	if (m->normal)
		mr_print(s, "property double nx\nproperty double ny\nproperty double nz\n");
	if (m->color)
		mr_print(s,
		    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n");
	if (m->texcoord)
		mr_print(s, "property double s\nproperty double t\n");
	if (m->nf)
		mr_print(s, "element face %zu\nproperty list uchar int vertex_indices\n", m->nf);
	if (m->nf && m->group)
		mr_print(s, "property uint group\n");
	mr_print(s, "end_header\n");
}

static char *
reals(char *to, const double *x, size_t n, order o)
{
	for (size_t i = 0; i < n; i++) {
		if (o == ASCII) {
			to = mr_real_write(to, x[i]);
			*to++ = ' ';
		} else
			to = mr_store_double(to, x[i], o == BIG);
	}
	return to;
}

static char *
count(char *to, uint32_t n, order o)
{
	if (o != ASCII)
		return mr_store32(to, n, o == BIG);
	to = mr_count_write(to, n);
	*to++ = ' ';
	return to;
}

static char *
bytes(char *to, const unsigned char *x, size_t n, order o)
{
	for (size_t i = 0; i < n; i++) {
		if (o == ASCII) {
			to = mr_count_write(to, x[i]);
			*to++ = ' ';
		} else
			*to++ = (char)x[i];
	}
	return to;
}

/* In text, the last blank of a row becomes its newline. */
static void
end_row(mr_sink *s, char *to, order o)
{
	if (o == ASCII)
		to[-1] = '\n';
	mr_sink_fill(s, to);
}

static mr_status
put(mr_sink *s, const mr_model *m, order o)
{
	static const unsigned char three = 3;

	put_header(s, m, o);
	for (size_t i = 0; i < m->nv; i++) {
		char *to = reals(mr_sink_room(s), &m->p[i].x, 3, o);
		if (m->normal)
			to = reals(to, &m->normal[i].x, 3, o);
		if (m->color)
			to = bytes(to, m->color + 4 * i, 4, o);
		if (m->texcoord)
			to = reals(to, m->texcoord + 2 * i, 2, o);
		end_row(s, to, o);
	}
	for (size_t f = 0; f < m->nf; f++) {
		char *to = bytes(mr_sink_room(s), &three, 1, o);
		for (int k = 0; k < 3; k++)
			to = count(to, m->t[f].v[k], o);
		if (m->group)
			to = count(to, m->group[f], o);
		end_row(s, to, o);
	}
	return MR_OK;
}

mr_status
mr_ply_write_little(mr_sink *s, const mr_model *m)
{
	return put(s, m, LITTLE);
}

mr_status
mr_ply_write_big(mr_sink *s, const mr_model *m)
{
	return put(s, m, BIG);
}

mr_status
mr_ply_write_ascii(mr_sink *s, const mr_model *m)
{
	return put(s, m, ASCII);
}
