/* gltf_text.h -- small glTF files made in memory, for tests that read and damage them. */
#ifndef GLTF_TEXT_H
#define GLTF_TEXT_H

#include "formats/gltf.h"

#include <stdarg.h>
#include <stdlib.h>

/* Bytes that grow; to be freed. */
typedef struct bytes {
	unsigned char *data;
	size_t size;
} bytes;

static inline void
add(bytes *b, const void *data, size_t size)
{
	b->data = realloc(b->data, b->size + size + 1);
	memcpy(b->data + b->size, data, size);
	b->size += size;
}

static inline void
add_word(bytes *b, uint32_t word)
{
	char text[4];

	mr_store32(text, word);
	add(b, text, 4);
}

static inline void
add_float(bytes *b, double x)
{
	char text[4];

	mr_store_float(text, (float)x);
	add(b, text, 4);
}

static inline void
add_floats(bytes *b, size_t n, ...)
{
	va_list args;

	va_start(args, n);
	for (size_t i = 0; i < n; i++)
		add_float(b, va_arg(args, double));
	va_end(args);
}

/* A GLB of this JSON and these bytes, of which there may be none. */
static inline bytes
make_glb(const char *json, const bytes *bin)
{
	size_t text = strlen(json), padded = (text + 3) / 4 * 4, more = bin ? (bin->size + 3) / 4 * 4 : 0;
	bytes b = { 0 };

	add_word(&b, MR_GLTF_MAGIC);
	add_word(&b, 2);
	add_word(&b, (uint32_t)(20 + padded + (bin ? 8 + more : 0)));
	add_word(&b, (uint32_t)padded);
	add_word(&b, MR_GLTF_JSON);
	add(&b, json, text);
	add(&b, "   ", padded - text);
	if (bin) {
		add_word(&b, (uint32_t)more);
		add_word(&b, MR_GLTF_BIN);
		add(&b, bin->data, bin->size);
		add(&b, "\0\0\0", more - bin->size);
	}
	return b;
}

/*
 * A square of two triangles in the plane z = 0 whose diagonal is a seam: six vertices at four places, a
 * texture coordinate each, indices, a material, a name.  bytes: 72 of positions, 48 of coordinates, 6 of
 * indices.
 */
static const char square_json[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
    "\"nodes\":[{\"mesh\":0,\"name\":\"square\"}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"indices\":2,"
    "\"material\":0}]}],\"materials\":[{\"name\":\"paper\"}],\"buffers\":[{\"byteLength\":126}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":72},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":48},"
    "{\"buffer\":0,\"byteOffset\":120,\"byteLength\":6}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":6,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[1,1,0]},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":6,\"type\":\"VEC2\"},"
    "{\"bufferView\":2,\"componentType\":5121,\"count\":6,\"type\":\"SCALAR\"}]}";

static inline bytes
square_bin(void)
{
	static const unsigned char index[] = { 0, 1, 2, 3, 4, 5 };
	bytes b = { 0 };

	add_floats(&b, 18, 0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 0., 0., 1., 1., 0., 0., 1., 0.);
	add_floats(&b, 12, 0., 1., 0.5, 1., 0.5, 0.5, 0.5, 0.5, 1., 0., 0.5, 0.);
	add(&b, index, sizeof index);
	return b;
}

static inline bytes
square_glb(void)
{
	bytes bin = square_bin(), glb = make_glb(square_json, &bin);

	free(bin.data);
	return glb;
}

/* The same as text; a name of three bytes of UTF-8, and a triangle alone, by a data URI. */
static const char triangle_gltf[] =
    " {\"asset\":{\"version\":\"2.1\",\"minVersion\":\"2.0\"},\"meshes\":[{\"name\":\"\xe2\x96\xb3\","
    "\"primitives\":"
    "[{\"attributes\":{\"POSITION\":0}}]}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/"
    "octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}],\"bufferViews\":[{\"buffer\":0,"
    "\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":"
    "\"VEC3\"}]}";

#endif
