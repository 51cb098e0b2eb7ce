/* SPDX-License-Identifier: MIT */
/* deflate_block.c - entropy coding of deflate (RFC 1951, 3.2): writes the tokens of a block as bits.
 *
 * Each block may have its own Huffman codes, one for literals and lengths and one for distances. The block's header
 * lists the lengths of their code words. These lengths are run-length encoded and then Huffman coded with a third code,
 * the "precode".
 *
 * For each block this file counts the symbols and builds both codes. It computes the exact size of the block in three
 * forms: with these codes, with the fixed codes of the standard, and stored without compression. The smallest form is
 * written.
 *
 * Bits are collected in a 64-bit word and moved to the output in whole bytes (output_whole_bytes()). Literals and
 * repeats are written by the same code without a branch, because a processor cannot predict the kind of the next token.
 * To make this possible, list_token_prefixes() prepares, for each of the 512 kinds of tokens, the bits of the symbol
 * together with the extra bits of a length. The three literals of an RGB pixel are one token, which takes a third of
 * the work; most tokens of a shaded picture are such pixels, so their branch is well predicted. */
#include "deflate_block.h"
#include "bytes.h"

#include <string.h>

enum {
    PRECODE_SYMBOLS = 19,
    LONGEST_PRECODE = 7,
    HEADER_ROOM = DEFLATE_LITERALS + DEFLATE_DISTANCES,
    PART_TOKENS = INDEXED_BLOCK_TOKENS + BLOCK_SPARE, /* room is reserved for so many tokens at once */
    /* the greatest size in bytes of a header and PART_TOKENS tokens: at most 48 bits per token and 16 bits per code
     * length, with some reserve */
    MOST_OF_PART = 6 * PART_TOKENS + 2 * HEADER_ROOM + 64
};

/* RFC 1951, 3.2.5: the smallest length or distance of each symbol, and the symbol's number of extra bits. */

static const uint16_t length_bases[] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                        31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
static const uint8_t length_extra[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                       2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
static const uint16_t distance_bases[] = {1,    2,    3,    4,    5,    7,    9,    13,    17,    25,
                                          33,   49,   65,   97,   129,  193,  257,  385,   513,   769,
                                          1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
static const uint8_t distance_extra[] = {0, 0, 0, 0, 1, 1, 2,  2,  3,  3,  4,  4,  5,  5,  6, 6,
                                         7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13, 0};

void deflate_begin_blocks(deflate_blocks *b, size_t most, deflate_sink *sink, void *context)
{
    b->most = most;
    b->sink = sink;
    b->context = context;
    b->writer.to = b->output;
    for (uint8_t symbol = 0; symbol < sizeof length_extra; symbol++)
        for (int i = 0; i < 1 << length_extra[symbol] && length_bases[symbol] + i <= DEFLATE_LONGEST; i++)
            b->length_symbols[length_bases[symbol] + i - DEFLATE_SHORTEST] = symbol;
    for (uint8_t symbol = 0; symbol < DEFLATE_DISTANCES; symbol++)
        for (int at = distance_bases[symbol] - 1, end = at + (1 << distance_extra[symbol]); at < end;
             at += at < 256 ? 1 : 128)
            b->distance_symbols[at < 256 ? at : 256 + (at >> 7)] = symbol;
}

void deflate_add_repeat(deflate_blocks *b, size_t length, size_t distance)
{
    const unsigned symbol = b->distance_symbols[distance <= 256 ? distance - 1 : 256 + ((distance - 1) >> 7)];
    const size_t extra = distance - distance_bases[symbol];
    b->distance_counts[symbol]++;
    b->tokens[b->count++] = (deflate_token)(DEFLATE_REPEAT + length - DEFLATE_SHORTEST) | symbol << DISTANCE_AT |
                            (deflate_token)extra << DISTANCE_EXTRA_AT;
}

/* ---- Bits ---------------------------------------------------------------------------------------------------- */

void deflate_flush_output(deflate_blocks *b)
{
    const size_t size = (size_t)(b->writer.to - b->output);
    b->writer.to = b->output;
    if (size > 0)
        b->sink(b->context, b->output, size);
}

/* Make room for the next PART_TOKENS tokens, and for a header before them. */
static void reserve_output(deflate_blocks *b)
{
    if ((size_t)(b->writer.to - b->output) > sizeof b->output - MOST_OF_PART)
        deflate_flush_output(b);
}

/* Append `count` bits. At most 56 bits may be appended between two calls of output_whole_bytes(). */
static inline void append_bits(bit_writer *w, uint32_t bits, int count)
{
    w->bits |= (uint64_t)bits << w->count;
    w->count += count;
}

/* Move all whole bytes from the 64-bit word to the output. reserve_output() has made room. */
static inline void output_whole_bytes(bit_writer *w)
{
    bytes_store_word(w->to, w->bits);
    w->to += w->count >> 3;
    w->bits >>= w->count & ~7;
    w->count &= 7;
}

static inline void append_symbol(bit_writer *w, const huffman_code *code, unsigned symbol)
{
    append_bits(w, code->bits[symbol], code->lengths[symbol]);
}

void deflate_write_bytes(deflate_blocks *b, const uint8_t *bytes, size_t size)
{
    bit_writer *w = &b->writer;
    if (w->count > 0)
        *w->to++ = (uint8_t)w->bits;
    w->bits = 0;
    w->count = 0;
    while (size > 0) {
        const size_t room = (size_t)(b->output + sizeof b->output - w->to), part = size < room ? size : room;
        memcpy(w->to, bytes, part);
        w->to += part;
        bytes += part;
        size -= part;
        if (part == room)
            deflate_flush_output(b);
    }
}

/* ---- Block headers ------------------------------------------------------------------------------------------- */

/* The lengths of the code words of both codes, run-length encoded: symbols of the precode, and the extra bits of each
 * symbol. */
typedef struct header {
    uint8_t symbols[HEADER_ROOM], extra[HEADER_ROOM];
    size_t count;
    size_t literal_count, distance_count, precode_count;
    huffman_code precode;
    uint32_t counts[PRECODE_SYMBOLS];
} header;

static const uint8_t extra_of_run[] = {2, 3, 7}; /* the number of extra bits of the precode's symbols 16 to 18 */

static void append_length_symbol(header *h, unsigned symbol, size_t extra)
{
    h->symbols[h->count] = (uint8_t)symbol;
    h->extra[h->count++] = (uint8_t)extra;
    h->counts[symbol]++;
}

static void append_code_lengths(header *h, const uint8_t *lengths, size_t count)
{
    for (size_t at = 0, end; at < count; at = end) {
        const uint8_t length = lengths[at];
        end = at;
        while (end < count && lengths[end] == length)
            end++;
        size_t left = end - at;
        if (length != 0) {
            append_length_symbol(h, length, 0);
            left--;
        }
        const size_t most = length ? 6 : 138;
        for (; left >= 3; left -= left < most ? left : most) {
            const size_t part = left < most ? left : most;
            if (length)
                append_length_symbol(h, 16, part - 3);
            else
                append_length_symbol(h, part < 11 ? 17 : 18, part < 11 ? part - 3 : part - 11);
        }
        for (; left > 0; left--)
            append_length_symbol(h, length, 0);
    }
}

static const uint8_t precode_order[PRECODE_SYMBOLS] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                       11, 4,  12, 3, 13, 2, 14, 1, 15};

/* Returns the number of symbols without the unused symbols at the end, but at least `least`. */
static size_t count_used_symbols(const uint8_t *lengths, size_t count, size_t least)
{
    while (count > least && lengths[count - 1] == 0)
        count--;
    return count;
}

static void make_header(header *h, const deflate_blocks *b)
{
    uint8_t lengths[HEADER_ROOM];
    memset(h->counts, 0, sizeof h->counts);
    h->count = 0;
    h->literal_count = count_used_symbols(b->literals.lengths, DEFLATE_LITERALS - 2, DEFLATE_END + 1);
    h->distance_count = count_used_symbols(b->distances.lengths, DEFLATE_DISTANCES, 1);
    memcpy(lengths, b->literals.lengths, h->literal_count);
    memcpy(lengths + h->literal_count, b->distances.lengths, h->distance_count);
    append_code_lengths(h, lengths, h->literal_count + h->distance_count);
    huffman_build_code(&h->precode, h->counts, PRECODE_SYMBOLS, LONGEST_PRECODE);
    h->precode_count = PRECODE_SYMBOLS;
    while (h->precode_count > 4 && h->precode.lengths[precode_order[h->precode_count - 1]] == 0)
        h->precode_count--;
}

static size_t count_header_bits(const header *h)
{
    size_t bits = 5 + 5 + 4 + 3 * h->precode_count;
    for (unsigned i = 0; i < PRECODE_SYMBOLS; i++)
        bits += h->counts[i] * (h->precode.lengths[i] + (i < 16 ? 0u : extra_of_run[i - 16]));
    return bits;
}

static void append_header(bit_writer *w, const header *h)
{
    append_bits(w, (uint32_t)(h->literal_count - DEFLATE_END - 1), 5);
    append_bits(w, (uint32_t)(h->distance_count - 1), 5);
    append_bits(w, (uint32_t)(h->precode_count - 4), 4);
    for (size_t i = 0; i < h->precode_count; i++) {
        output_whole_bytes(w);
        append_bits(w, h->precode.lengths[precode_order[i]], 3);
    }
    for (size_t i = 0; i < h->count; i++) {
        const unsigned symbol = h->symbols[i];
        output_whole_bytes(w);
        append_symbol(w, &h->precode, symbol);
        if (symbol >= 16)
            append_bits(w, h->extra[i], extra_of_run[symbol - 16]);
    }
    output_whole_bytes(w);
}

/* ---- Blocks -------------------------------------------------------------------------------------------------- */

static size_t count_token_bits(const deflate_blocks *b, const uint8_t *literals, const uint8_t *distances)
{
    size_t bits = 0;
    for (size_t i = 0; i < DEFLATE_LITERALS; i++)
        bits += (size_t)b->literal_counts[i] * literals[i];
    for (size_t i = 0; i < DEFLATE_DISTANCES; i++)
        bits += (size_t)b->distance_counts[i] * distances[i];
    return bits;
}

static void set_fixed_lengths(huffman_code *literals, huffman_code *distances)
{
    for (int i = 0; i < DEFLATE_LITERALS; i++)
        literals->lengths[i] = (uint8_t)(i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8);
    memset(distances->lengths, 5, DEFLATE_DISTANCES);
}

static inline unsigned token_kind(deflate_token token)
{
    return token % TOKEN_KINDS;
}

static inline unsigned distance_symbol(deflate_token token)
{
    return (token >> DISTANCE_AT) % (1 << (DISTANCE_EXTRA_AT - DISTANCE_AT));
}

static void count_literals(deflate_blocks *b)
{
    /* One array for each literal of a pixel: counting the same byte twice in a row in one array would be slow. */
    uint32_t kinds[TOKEN_KINDS] = {0}, second[DEFLATE_REPEAT] = {0}, third[DEFLATE_REPEAT] = {0};
    memset(b->literal_counts, 0, sizeof b->literal_counts);
    for (size_t i = 0; i < b->count; i++) {
        const deflate_token t = b->tokens[i];
        if (t & DEFLATE_PIXEL) {
            kinds[t & 255]++;
            second[t >> 8 & 255]++;
            third[t >> 16 & 255]++;
        } else {
            kinds[token_kind(t)]++;
        }
    }
    for (int byte = 0; byte < DEFLATE_REPEAT; byte++)
        b->literal_counts[byte] = kinds[byte] + second[byte] + third[byte];
    b->literal_counts[DEFLATE_END] = 1;
    for (int more = 0; more < TOKEN_KINDS - DEFLATE_REPEAT; more++)
        b->literal_counts[DEFLATE_END + 1 + b->length_symbols[more]] += kinds[DEFLATE_REPEAT + more];
}

/* Bits that one call of append_bits() writes. */
typedef struct bit_string {
    uint32_t bits;
    int32_t count;
} bit_string;

/* List, for each kind of token, the bits with which it begins: the code word of its symbol, then the extra bits of a
 * length. */
static void list_token_prefixes(bit_string of[TOKEN_KINDS], const deflate_blocks *b)
{
    const huffman_code *code = &b->literals;
    for (int byte = 0; byte < DEFLATE_REPEAT; byte++)
        of[byte] = (bit_string){code->bits[byte], code->lengths[byte]};
    for (int more = 0; more < TOKEN_KINDS - DEFLATE_REPEAT; more++) {
        const unsigned of_length = b->length_symbols[more], symbol = DEFLATE_END + 1 + of_length;
        const uint32_t extra = (uint32_t)(more + DEFLATE_SHORTEST - length_bases[of_length]);
        of[DEFLATE_REPEAT + more] = (bit_string){code->bits[symbol] | extra << code->lengths[symbol],
                                                 code->lengths[symbol] + length_extra[of_length]};
    }
}

static inline void append_pixel(bit_writer *w, const bit_string prefixes[TOKEN_KINDS], deflate_token pixel)
{
    const bit_string a = prefixes[pixel & 255], b = prefixes[pixel >> 8 & 255], c = prefixes[pixel >> 16 & 255];
    w->bits |= (a.bits | ((uint64_t)b.bits | (uint64_t)c.bits << b.count) << a.count) << w->count;
    w->count += a.count + b.count + c.count;
}

/* Append a literal or a repeat. */
static inline void append_token(bit_writer *w, const bit_string prefixes[TOKEN_KINDS], const huffman_code *distances,
                                deflate_token t)
{
    const bit_string prefix = prefixes[token_kind(t)];
    append_bits(w, prefix.bits, prefix.count);
    append_symbol(w, distances, distance_symbol(t));
    append_bits(w, t >> DISTANCE_EXTRA_AT, distance_extra[distance_symbol(t)]);
}

static void append_tokens(deflate_blocks *b)
{
    bit_string prefixes[TOKEN_KINDS];
    list_token_prefixes(prefixes, b);
    b->distances.lengths[DEFLATE_DISTANCES] = 0;
    b->distances.bits[DEFLATE_DISTANCES] = 0;
    for (size_t i = 0, end; i < b->count;) {
        if (i > 0)
            reserve_output(b);
        bit_writer w = b->writer; /* a local copy of the writer, which the compiler keeps in registers */
        for (end = i + PART_TOKENS < b->count ? i + PART_TOKENS : b->count; i < end; i++) {
            const deflate_token t = b->tokens[i];
            if (t & DEFLATE_PIXEL)
                append_pixel(&w, prefixes, t);
            else
                append_token(&w, prefixes, &b->distances, t);
            output_whole_bytes(&w);
        }
        b->writer = w;
    }
    append_symbol(&b->writer, &b->literals, DEFLATE_END);
    output_whole_bytes(&b->writer);
}

enum { STORED, FIXED, DYNAMIC };

static void write_stored_block(deflate_blocks *b, const uint8_t *bytes, size_t size, bool last)
{
    const uint8_t sizes[4] = {(uint8_t)size, (uint8_t)(size >> 8), (uint8_t)~size, (uint8_t)(~size >> 8)};
    append_bits(&b->writer, (uint32_t)(last | STORED << 1), 3);
    output_whole_bytes(&b->writer);
    deflate_write_bytes(b, sizes, sizeof sizes);
    deflate_write_bytes(b, bytes, size);
}

/* Write the tokens of a block. The block uses its own codes, which `h` describes, or the fixed codes if `h` is null. */
static void write_coded_block(deflate_blocks *b, const header *h, bool last)
{
    append_bits(&b->writer, (uint32_t)(last | (h ? DYNAMIC : FIXED) << 1), 3);
    if (h)
        append_header(&b->writer, h);
    append_tokens(b);
}

void deflate_write_block(deflate_blocks *b, const uint8_t *bytes, size_t size, bool last)
{
    header h;
    huffman_code fixed[2];
    reserve_output(b);
    count_literals(b);
    huffman_build_code(&b->literals, b->literal_counts, DEFLATE_LITERALS - 2, HUFFMAN_LONGEST);
    huffman_build_code(&b->distances, b->distance_counts, DEFLATE_DISTANCES, HUFFMAN_LONGEST);
    make_header(&h, b);
    set_fixed_lengths(&fixed[0], &fixed[1]);
    const size_t dynamic_bits = count_header_bits(&h) + count_token_bits(b, b->literals.lengths, b->distances.lengths);
    const size_t fixed_bits = count_token_bits(b, fixed[0].lengths, fixed[1].lengths);
    const size_t coded_bits = dynamic_bits < fixed_bits ? dynamic_bits : fixed_bits;
    if (bytes && size <= 65535 && 8 * size + 32 + 7 < coded_bits) {
        write_stored_block(b, bytes, size, last);
    } else if (dynamic_bits < fixed_bits) {
        write_coded_block(b, &h, last);
    } else {
        huffman_assign_code_words(&fixed[0], DEFLATE_LITERALS);
        huffman_assign_code_words(&fixed[1], DEFLATE_DISTANCES);
        b->literals = fixed[0];
        b->distances = fixed[1];
        write_coded_block(b, NULL, last);
    }
    b->count = 0;
    memset(b->distance_counts, 0, sizeof b->distance_counts);
}
