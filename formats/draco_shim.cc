#include "formats/draco_shim.h"

#include <cstdio>

#if __has_include(<draco/compression/decode.h>)
#include <draco/compression/decode.h>

#include <memory>

struct mr_draco {
	std::unique_ptr<draco::Mesh> mesh;
};

extern "C" mr_draco *
mr_draco_open(const void *data, size_t bytes, char why[MR_DRACO_WHY])
{
	try {
		draco::DecoderBuffer buffer;
		draco::Decoder decoder;

		buffer.Init(static_cast<const char *>(data), bytes);
		auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
		if (mesh.ok())
			return new mr_draco{ std::move(mesh).value() };
		snprintf(why, MR_DRACO_WHY, "%s", mesh.status().error_msg());
	} catch (...) {
		snprintf(why, MR_DRACO_WHY, "no memory for what %zu bytes decode to", bytes);
	}
	return nullptr;
}

extern "C" void
mr_draco_free(void *draco)
{
	delete static_cast<mr_draco *>(draco);
}

extern "C" size_t
mr_draco_points(const mr_draco *d)
{
	return d->mesh->num_points();
}

extern "C" size_t
mr_draco_faces(const mr_draco *d)
{
	return d->mesh->num_faces();
}

extern "C" void
mr_draco_indices(const mr_draco *d, uint32_t *index)
{
	for (uint32_t f = 0; f < d->mesh->num_faces(); f++)
		for (size_t k = 0; k < 3; k++)
			*index++ = d->mesh->face(draco::FaceIndex(f))[k].value();
}

extern "C" bool
mr_draco_values(const mr_draco *d, uint32_t id, size_t width, float *x, bool *normalized)
{
	const draco::PointAttribute *a = d->mesh->GetAttributeByUniqueId(id);

	if (!a || static_cast<size_t>(a->num_components()) < width)
		return false;
	for (uint32_t i = 0; i < d->mesh->num_points(); i++) {
		draco::AttributeValueIndex at = a->mapped_index(draco::PointIndex(i));
		if (at.value() >= a->size() ||
		    !a->ConvertValue<float>(at, static_cast<int8_t>(width), x + i * width))
			return false;
	}
	*normalized = a->normalized();
	return true;
}
#else
extern "C" mr_draco *
mr_draco_open(const void *, size_t, char why[MR_DRACO_WHY])
{
	snprintf(why, MR_DRACO_WHY, "this mr was built without libdraco (Debian's libdraco-dev)");
	return nullptr;
}

extern "C" void
mr_draco_free(void *)
{
}

extern "C" size_t
mr_draco_points(const mr_draco *)
{
	return 0;
}

extern "C" size_t
mr_draco_faces(const mr_draco *)
{
	return 0;
}

extern "C" void
mr_draco_indices(const mr_draco *, uint32_t *)
{
}

extern "C" bool
mr_draco_values(const mr_draco *, uint32_t, size_t, float *, bool *)
{
	return false;
}
#endif
