#include "formats/obj_shim.h"

#define TINYOBJLOADER_USE_DOUBLE /* as the library was built */
#include <tiny_obj_loader.h>

#include <cstddef>
#include <istream>
#include <streambuf>

static_assert(sizeof(tinyobj::index_t) == sizeof(mr_obj_corner) &&
		  offsetof(tinyobj::index_t, vertex_index) == 0 &&
		  offsetof(tinyobj::index_t, normal_index) == offsetof(mr_obj_corner, vn) &&
		  offsetof(tinyobj::index_t, texcoord_index) == offsetof(mr_obj_corner, vt),
    "the indices of tinyobj have the layout of ours");

namespace {

/* A stream whose buffer is one line after another, in the caller's memory. */
class lines : public std::streambuf {
      public:
	explicit lines(const mr_obj_calls &c) : calls(c)
	{
	}

      protected:
	int_type underflow() override
	{
		const char *begin, *end;

		if (!calls.line(calls.user, &begin, &end))
			return traits_type::eof();
		setg(const_cast<char *>(begin), const_cast<char *>(begin), const_cast<char *>(end));
		return traits_type::to_int_type(*begin);
	}

      private:
	const mr_obj_calls &calls;
};

const mr_obj_calls &
of(void *user)
{
	return *static_cast<const mr_obj_calls *>(user);
}

} // namespace

bool
mr_obj_parse(const mr_obj_calls *calls)
{
	tinyobj::callback_t c;

	c.index_cb = [](void *user, tinyobj::index_t *corner, int n) {
		of(user).face(of(user).user, reinterpret_cast<const mr_obj_corner *>(corner), n);
	};
	try {
		lines buffer(*calls);
		std::istream stream(&buffer);
		return tinyobj::LoadObjWithCallback(stream, c, const_cast<mr_obj_calls *>(calls));
	} catch (...) {
		return false;
	}
}
