/* The file: a head and blocks, each with its checksum. */
#include "compact/packed.h"

#include "compact/lifting.h"

enum { BLOCK = 4096, CHECK = 4, FEW = 1024, MOST_A_BYTE = 1 << 14, CREASES = 1, COLORS = 2, OPACITY = 4 };
enum { COLOR_PASS = 2 }; /* after it colours look right: lightness is exact to 16 of 255 */
static const char magic[] = "mrz1\n";
static uint8_t some_crease; /* its address asks mr_control_read for creases */
enum { MAGIC = sizeof magic - 1 };

/* zlib's CRC-32, which the page needs, too. */
static uint32_t
checksum(const unsigned char *byte, size_t n)
{
	uint32_t crc = UINT32_MAX;

	for (size_t i = 0; i < n; i++) {
		crc ^= byte[i];
		for (int k = 0; k < 8; k++)
			crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
	}
	return ~crc;
}

typedef struct output {
	mr_ctx *ctx;
	unsigned char *byte;
	size_t count, room;
} output;

static void
put(output *o, const void *byte, size_t n)
{
	MR_RESERVE(o->ctx, o->byte, o->count, n, &o->room);
	if (n)
		memcpy(o->byte + o->count, byte, n);
	o->count += n;
}

/* Seven bits a byte, the lowest first; more follow where the highest bit is set. */
static void
put_number(output *o, uint64_t x)
{
	for (; x >= 128; x >>= 7)
		put(o, &(unsigned char){ (unsigned char)(128 | (x & 127)) }, 1);
	put(o, &(unsigned char){ (unsigned char)x }, 1);
}

static void
put_signed(output *o, int64_t x)
{
	put_number(o, x < 0 ? ~((uint64_t)x << 1) : (uint64_t)x << 1);
}

static void
put_checked(output *o, const unsigned char *byte, size_t n)
{
	uint32_t crc = checksum(byte, n);
	unsigned char check[CHECK] = { (unsigned char)crc, (unsigned char)(crc >> 8),
		(unsigned char)(crc >> 16), (unsigned char)(crc >> 24) };

	put(o, byte, n);
	put(o, check, CHECK);
}

static bool
is_checked(const unsigned char *byte, size_t n)
{
	const unsigned char *c = byte + n;

	return checksum(byte, n) ==
	       ((uint32_t)c[0] | (uint32_t)c[1] << 8 | (uint32_t)c[2] << 16 | (uint32_t)c[3] << 24);
}

mr_packed_bytes
mr_packed_file(mr_ctx *ctx, const mr_packed *p, const mr_coder *control, mr_packed_bytes bits)
{
	output head = { .ctx = ctx }, o = { .ctx = ctx };
	size_t name = strlen(p->name);

	put_number(&head, (p->control.crease ? CREASES : 0u) | (p->fields > 1 ? COLORS : 0u) |
			      (p->fields > 4 ? OPACITY : 0u));
	put_number(&head, p->control.nv);
	put_number(&head, p->control.nf);
	put_number(&head, p->n);
	put_signed(&head, p->step);
	for (int i = 0; i < 3; i++)
		put_signed(&head, p->origin[i]);
	put_signed(&head, p->unit);
	put_number(&head, bits.size);
	for (size_t i = 0; i < p->fields; i++)
		put(&head, p->field[i].planes, p->n + 1);
	put_number(&head, name);
	put(&head, p->name, name);
	put(&head, control->byte, control->count);
	put(&o, magic, MAGIC);
	put_number(&o, head.count);
	put_checked(&o, head.byte, head.count);
	for (size_t at = 0; at < bits.size; at += BLOCK)
		put_checked(&o, bits.byte + at, bits.size - at < BLOCK ? bits.size - at : BLOCK);
	return (mr_packed_bytes){ o.byte, o.count };
}

size_t
mr_packed_room(size_t head, size_t size)
{
	size_t rest = size > head ? size - head : 0,
	       checks = (rest + BLOCK + CHECK - 1) / (BLOCK + CHECK) * CHECK;

	return rest > checks ? rest - checks : 0;
}

mr_status
mr_packed_levels(mr_ctx *ctx, mr_packed *p, bool faces)
{
	mr_v3 *position = MR_NEW(ctx, p->control.nv, mr_v3);
	mr_mesh m = { "control", position, p->control.t, p->control.nv, p->control.nf };
	mr_loop *level = MR_NEW(ctx, p->n + 1, mr_loop);
	bool light = !faces && p->n > 0;

	mr_packed_positions(p, position);
	MR_TRY(mr_loop_levels(ctx, &m, 180, p->control.crease, p->n - light, level));
	if (light)
		mr_loop_refine_vertices(ctx, &level[p->n - 1], &level[p->n]);
	p->level = level;
	return MR_OK;
}

void
mr_packed_positions(const mr_packed *p, mr_v3 *position)
{
	for (size_t v = 0; v < p->control.nv; v++) {
		const int32_t *x = p->control.p[v].x;
		position[v] = mr_vec(ldexp((double)(p->origin[0] + x[0]), p->step),
		    ldexp((double)(p->origin[1] + x[1]), p->step),
		    ldexp((double)(p->origin[2] + x[2]), p->step));
	}
}

mr_status
mr_packed_write_fields(mr_ctx *ctx, mr_packed *p, mr_packed_bytes *bits, size_t *least)
{
	size_t end[MR_BIT_PLANES_MOST] = { 0 };
	mr_coder c;

	for (size_t i = 0; i < p->fields; i++) {
		mr_lifting_analyse(ctx, p->level, p->n, p->field[i].x);
		MR_TRY(mr_bit_planes_count(ctx, p->level, p->n, &p->field[i]));
	}
	mr_coder_write(ctx, &c);
	mr_bit_planes_code(ctx, &c, p->level, p->n, p->field, p->fields, end);
	mr_coder_finish(&c);
	*bits = (mr_packed_bytes){ c.byte, c.count };
	*least = p->fields > 1 && end[COLOR_PASS] < c.count ? end[COLOR_PASS] : 0;
	return MR_OK;
}

void
mr_packed_read_fields(mr_ctx *ctx, mr_packed *p, mr_packed_bytes bits, size_t upto)
{
	mr_coder c;

	for (size_t i = 0; i < p->fields; i++)
		p->field[i].x = MR_NEW_ZERO(ctx, p->level[p->n].nv, int32_t);
	mr_coder_read(bits.byte, bits.size, &c);
	mr_bit_planes_code(ctx, &c, p->level, p->n, p->field, p->fields, NULL);
	for (size_t i = 0; i < p->fields; i++)
		mr_lifting_synthesize(ctx, p->level, upto, p->field[i].x);
}

/* The rest of the input. */
typedef struct input {
	const unsigned char *byte;
	size_t size;
	bool bad; /* more was wanted, or a number beyond 64 bits */
} input;

static uint64_t
get_number(input *in)
{
	uint64_t x = 0;

	for (unsigned shift = 0; in->size && shift < 64; shift += 7) {
		unsigned char byte = *in->byte++;
		in->size--;
		x |= (uint64_t)(byte & 127) << shift;
		if (byte < 128)
			return x;
	}
	in->bad = true;
	return 0;
}

/* A number up to `most`. */
static size_t
get_below(input *in, size_t most)
{
	uint64_t x = get_number(in);

	in->bad |= x > most;
	return x > most ? 0 : (size_t)x;
}

static int64_t
get_signed(input *in, int64_t most)
{
	uint64_t x = get_number(in);
	int64_t value = x & 1 ? -(int64_t)(x >> 1) - 1 : (int64_t)(x >> 1);

	in->bad |= value > most || value < -most;
	return value > most || value < -most ? 0 : value;
}

static void
get_bytes(input *in, void *to, size_t n)
{
	if (n > in->size) {
		in->bad = true;
		return;
	}
	memcpy(to, in->byte, n);
	in->byte += n;
	in->size -= n;
}

/* Reads the head up to the bits of the control mesh.  *total: bytes of the fields. */
static mr_status
get_head(mr_ctx *ctx, input *in, mr_packed *p, size_t *total)
{
	uint64_t flags = get_below(in, CREASES | COLORS | OPACITY),
		 most = (uint64_t)(in->size + FEW) * MOST_A_BYTE, vertices = UINT32_MAX / 2,
		 faces = UINT32_MAX / 6;

	*p = (mr_packed){ .fields = flags & OPACITY ? 5 : flags & COLORS ? 4 : 1 };
	p->control.nv = get_below(in, (size_t)(most < vertices ? most : vertices));
	p->control.nf = get_below(in, (size_t)(most < faces ? most : faces));
	p->control.crease = flags & CREASES ? &some_crease : NULL;
	p->n = get_below(in, MR_LEVEL_MAX);
	p->step = (int)get_signed(in, 1000);
	for (int i = 0; i < 3; i++)
		p->origin[i] = get_signed(in, (int64_t)1 << 52);
	p->unit = (int)get_signed(in, 1000);
	*total = get_below(in, SIZE_MAX / 2);
	for (size_t i = 0; i < p->fields; i++) {
		get_bytes(in, p->field[i].planes, p->n + 1);
		for (size_t j = 0; j <= p->n; j++)
			in->bad |= p->field[i].planes[j] > MR_BIT_PLANES_MOST;
	}
	get_bytes(in, p->name, get_below(in, MR_PACKED_NAME));
	in->bad |= p->control.nf == 0 || ((flags & OPACITY) && !(flags & COLORS));
	return in->bad ? mr_fail(ctx, MR_EFORMAT, "its head is damaged") : MR_OK;
}

/* Reads the control mesh; refuses more levels of it than a file of this size may have. */
static mr_status
get_control(mr_ctx *ctx, const input *in, size_t size, mr_packed *p)
{
	mr_topology topo;
	mr_loop level;
	mr_coder c;
	mr_mesh m;

	mr_coder_read(in->byte, in->size, &c);
	MR_TRY(mr_control_read(ctx, &c, &p->control));
	m = (mr_mesh){ "control", NULL, p->control.t, p->control.nv, p->control.nf };
	MR_TRY(mr_topology_build(ctx, &m, &topo));
	level = (mr_loop){ .nv = m.nv, .nf = m.nf, .t = m.t, .topo = topo };
	if (mr_loop_count(m.nv, m.nf, mr_loop_boundary(&level), p->n) / MOST_A_BYTE > size + FEW)
		return mr_fail(ctx, MR_EFORMAT, "%zu levels are more than so few bytes can mean", p->n);
	return MR_OK;
}

/* Puts the blocks together, each as its checksum says; the last one may be cut off, and is then not checked.
 */
static mr_status
get_bits(mr_ctx *ctx, const input *in, size_t total, mr_packed_bytes *bits, size_t *missing)
{
	size_t room = mr_packed_room(0, in->size), at = 0, done = 0;
	unsigned char *byte = MR_NEW(ctx, room < total ? room + CHECK : total, unsigned char);

	while (done < total && at < in->size) {
		size_t n = total - done < BLOCK ? total - done : BLOCK, there = in->size - at;
		if (there >= n + CHECK && !is_checked(in->byte + at, n))
			return mr_fail(ctx, MR_EFORMAT, "damaged behind byte %zu of its heights", done);
		there = there < n + CHECK ? (there < n ? there : n) : n;
		memcpy(byte + done, in->byte + at, there);
		done += there;
		at += n + CHECK;
	}
	*bits = (mr_packed_bytes){ byte, done };
	*missing = at < in->size || done < total ? total - done : at - in->size;
	return MR_OK;
}

mr_status
mr_packed_open(mr_ctx *ctx, mr_packed_bytes file, mr_packed *p, mr_packed_bytes *bits, size_t *missing)
{
	input in = { file.byte, file.size, false }, head;
	size_t size, total;

	if (file.size < MAGIC || memcmp(file.byte, magic, MAGIC))
		return mr_fail(ctx, MR_EFORMAT, "no packed surface: it does not begin with mrz1");
	in.byte += MAGIC;
	in.size -= MAGIC;
	size = get_below(&in, SIZE_MAX / 2);
	if (in.bad || in.size < size + CHECK)
		return mr_fail(ctx, MR_EFORMAT, "it ends before its control mesh");
	if (!is_checked(in.byte, size))
		return mr_fail(ctx, MR_EFORMAT, "its control mesh is damaged");
	head = (input){ in.byte, size, false };
	in.byte += size + CHECK;
	in.size -= size + CHECK;
	MR_TRY(get_head(ctx, &head, p, &total));
	MR_TRY(get_control(ctx, &head, file.size, p));
	return get_bits(ctx, &in, total, bits, missing);
}
