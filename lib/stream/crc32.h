/* crc32.h -- the checksum of records. */
#ifndef MR_STREAM_CRC32_H
#define MR_STREAM_CRC32_H

#include <stddef.h>
#include <stdint.h>

/* The CRC-32 of zlib after n more bytes; it begins with 0. */
uint32_t mr_crc32(uint32_t crc, const void *bytes, size_t n);

#endif
