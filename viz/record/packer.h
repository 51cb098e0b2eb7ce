/* SPDX-License-Identifier: MIT */
/* packer.h - compresses bytes as gzip does, and writes them into a page as letters. */
#ifndef RECORD_PACKER_H
#define RECORD_PACKER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <zlib.h>

/* A packer must keep its address. If all of it is zero it has no memory, and packer_release() does nothing. */
typedef struct packer {
    z_stream z;
    unsigned char *bytes; /* the packed bytes up to now; owned */
    size_t room;
    bool begun, failed; /* failed: memory has run out */
} packer;

/* Pack the bytes of all calls of packer_add(). packer_end() returns the packed bytes, which the caller frees, or null
 * if memory has run out in any of the calls; *size becomes their number. The result depends on the bytes alone, and not
 * on how they were divided among the calls. */
void packer_begin(packer *p);
void packer_add(packer *p, const void *bytes, size_t size);
unsigned char *packer_end(packer *p, size_t *size);
void packer_release(packer *p);

/* Write bytes as text in a variant of Z85, which encodes four bytes as five characters. To suit HTML, this variant has
 * , _ ~ in place of & < @. The first character is the number of zero bytes that pad the last group of four.
 * unpackLetters() in unpack.js decodes the text. */
void write_letters(FILE *page, const unsigned char *bytes, size_t size);

#endif
