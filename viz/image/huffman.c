/* SPDX-License-Identifier: MIT */
/* huffman.c - builds Huffman codes in three steps, all in arrays of at most 288 entries.
 *
 * 1. Sort the symbols by count and compute the optimal code lengths in place (Moffat and Katajainen, 1995). The array
 * of weights is overwritten first with parent indices, then with depths, so that no tree is allocated.
 *
 * 2. Limit the lengths to the longest code word that deflate allows. Longer lengths are cut to this limit. The code
 * words then need more code space than exists. To gain space, a shorter code word is replaced by two code words that
 * are one bit longer, and one of the longest code words is replaced by the second of these two. This step is repeated
 * until the code words use the code space exactly.
 *
 * 3. Assign canonical code words by length, then by symbol, so that only the lengths need to be sent.
 *
 * The limited code is not always optimal; the package-merge algorithm would find an optimal code. But few
 * blocks reach deflate's limit of 15 bits, and only with their rarest symbols, so the difference does not matter. */
#include "deflate_block.h"

#include <string.h>

/* A sort key holds a symbol's count in its high bits and the symbol in its low bits, so that keys sort by count, then
 * by symbol. */
enum { SYMBOL_BITS = 9, SYMBOL_MASK = (1 << SYMBOL_BITS) - 1 };

/* Sort keys by their counts, which are below 65536, by two passes of a radix sort. A pass keeps the order of equal
 * digits, and the keys begin in the order of their symbols. */
static void sort_keys(uint32_t *keys, size_t count)
{
    uint32_t sorted[HUFFMAN_MOST_SYMBOLS];
    for (int shift = SYMBOL_BITS; shift < SYMBOL_BITS + 16; shift += 8) {
        uint16_t next[257] = {0}; /* next[digit]: the place of the next key with this digit */
        for (size_t i = 0; i < count; i++)
            next[(keys[i] >> shift & 255) + 1]++;
        for (int digit = 0; digit < 255; digit++)
            next[digit + 1] = (uint16_t)(next[digit + 1] + next[digit]);
        for (size_t i = 0; i < count; i++)
            sorted[next[keys[i] >> shift & 255]++] = keys[i];
        memcpy(keys, sorted, count * sizeof *keys);
    }
}

/* List the sort keys of the symbols that occur, in ascending order of their counts. Returns the number of keys. If
 * fewer than two symbols occur, two keys are listed. */
static size_t list_used_symbols(const uint32_t *counts, size_t count, uint32_t *keys)
{
    size_t used = 0;
    for (size_t i = 0; i < count; i++)
        if (counts[i] > 0)
            keys[used++] = counts[i] << SYMBOL_BITS | (uint32_t)i;
    for (size_t i = 0; used < 2; i++)
        if (counts[i] == 0)
            keys[used++] = (uint32_t)i;
    sort_keys(keys, used);
    return used;
}

/* Replace n >= 2 weights, in ascending order, by the code lengths of their symbols, in descending order. Source: Moffat
 * and Katajainen, "In-place calculation of minimum-redundancy codes". */
static void find_code_lengths(uint32_t *a, size_t n)
{
    a[0] += a[1];
    for (size_t root = 0, leaf = 2, next = 1; next + 1 < n; next++) {
        uint32_t sum = 0;
        for (int i = 0; i < 2; i++)
            if (leaf >= n || (root < next && a[root] < a[leaf])) {
                sum += a[root];
                a[root++] = (uint32_t)next;
            } else {
                sum += a[leaf++];
            }
        a[next] = sum;
    }
    a[n - 2] = 0;
    for (size_t i = n - 2; i-- > 0;)
        a[i] = a[a[i]] + 1;
    /* the inner nodes at indices from `root` on have been counted */
    size_t available = 1, used = 0, next = n, root = n - 1;
    for (uint32_t depth = 0; available > 0; depth++, available = 2 * used, used = 0) {
        for (; root > 0 && a[root - 1] == depth; root--)
            used++;
        for (; available > used; available--)
            a[--next] = depth;
    }
}

/* Count the code words of each length after limiting lengths to `longest` bits. `space` is the code space that all code
 * words need, in units of 2^-longest. While `space` exceeds the whole code space, the longest code word that is shorter
 * than `longest` is replaced by two code words that are one bit longer. One of the code words of `longest` bits is
 * replaced by the second of these two. */
static void count_limited_lengths(const uint32_t *lengths, size_t count, int longest, uint32_t *of_length)
{
    uint32_t space = 0;
    for (size_t i = 0; i < count; i++) {
        const int length = lengths[i] > (uint32_t)longest ? longest : (int)lengths[i];
        of_length[length]++;
        space += (uint32_t)1 << (longest - length);
    }
    for (; space > (uint32_t)1 << longest; space--) {
        int length = longest - 1;
        while (of_length[length] == 0)
            length--;
        of_length[longest]--;
        of_length[length]--;
        of_length[length + 1] += 2;
    }
}

/* Returns the lowest `count` bits in reverse order. */
static uint16_t reverse_bits(uint32_t bits, int count)
{
    bits = (bits & 0x5555) << 1 | (bits >> 1 & 0x5555);
    bits = (bits & 0x3333) << 2 | (bits >> 2 & 0x3333);
    bits = (bits & 0x0f0f) << 4 | (bits >> 4 & 0x0f0f);
    bits = (bits & 0x00ff) << 8 | bits >> 8;
    return (uint16_t)(bits >> (16 - count));
}

/* The last loop must run from the last symbol to the first. With the opposite order, GCC 12 for 64-bit Arm concludes
 * wrongly that huffman_assign_code_words() writes nothing, and drops calls of this function. */
void huffman_assign_code_words(huffman_code *code, size_t count)
{
    uint32_t of_length[HUFFMAN_LONGEST + 1] = {0}, ends[HUFFMAN_LONGEST + 1] = {0}, first = 0;
    for (size_t i = 0; i < count; i++)
        of_length[code->lengths[i]]++;
    of_length[0] = 0;
    for (int length = 1; length <= HUFFMAN_LONGEST; length++) {
        first = (first + of_length[length - 1]) << 1;
        ends[length] = first + of_length[length];
    }
    for (size_t i = count; i-- > 0;)
        code->bits[i] = reverse_bits(--ends[code->lengths[i]], code->lengths[i]);
}

void huffman_build_code(huffman_code *code, const uint32_t *counts, size_t count, int longest)
{
    uint32_t keys[HUFFMAN_MOST_SYMBOLS], lengths[HUFFMAN_MOST_SYMBOLS], of_length[HUFFMAN_LONGEST + 1] = {0};
    const size_t used = list_used_symbols(counts, count, keys);
    for (size_t i = 0; i < used; i++)
        lengths[i] = keys[i] >> SYMBOL_BITS;
    find_code_lengths(lengths, used);
    count_limited_lengths(lengths, used, longest, of_length);
    memset(code->lengths, 0, count);
    size_t at = 0;
    for (int length = longest; length > 0; length--)
        for (uint32_t n = of_length[length]; n > 0; n--)
            code->lengths[keys[at++] & SYMBOL_MASK] = (uint8_t)length;
    huffman_assign_code_words(code, count);
}
