/* utf8.c - see utf8.h. */
#include "utf8.h"

/* Well-formed UTF-8 beyond ASCII (table 3-7 of the Unicode standard): what the first byte says about the second and
 * about the length. */
static const struct {
    unsigned char first, last, second_min, second_max;
    size_t length;
} sequences[] = {
    {0xc2, 0xdf, 0x80, 0xbf, 2}, {0xe0, 0xe0, 0xa0, 0xbf, 3}, {0xe1, 0xec, 0x80, 0xbf, 3}, {0xed, 0xed, 0x80, 0x9f, 3},
    {0xee, 0xef, 0x80, 0xbf, 3}, {0xf0, 0xf0, 0x90, 0xbf, 4}, {0xf1, 0xf3, 0x80, 0xbf, 4}, {0xf4, 0xf4, 0x80, 0x8f, 4},
};

size_t utf8_length(const unsigned char *at)
{
    for (size_t i = 0; i < sizeof sequences / sizeof *sequences; i++) {
        if (at[0] < sequences[i].first || at[0] > sequences[i].last)
            continue;
        if (at[1] < sequences[i].second_min || at[1] > sequences[i].second_max)
            return 0;
        for (size_t j = 2; j < sequences[i].length; j++)
            if (at[j] < 0x80 || at[j] > 0xbf)
                return 0;
        return sequences[i].length;
    }
    return 0;
}
