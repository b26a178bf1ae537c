/* export.h -- what the page may call of the library. */
#ifndef MR_PAGE_EXPORT_H
#define MR_PAGE_EXPORT_H

#ifdef __wasm__
#define MR_EXPORT(name) __attribute__((export_name(#name)))
#else
#define MR_EXPORT(name)
#endif

#endif
