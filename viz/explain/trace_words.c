/* trace_words.c - see trace_words.h. */
#include "trace_words.h"
#include "layer.h"
#include "text.h"

#include <inttypes.h>

void trace_print_part(FILE *out, const trace_part *part)
{
    char text[OCTREE_ADDRESS_TEXT];
    if (part->layer == LAYER_NODES)
        fprintf(out, "node %s", octree_address_format(part->id, text));
    else if (part->layer == LAYER_POINTS)
        fprintf(out, "point %" PRIu64, part->id);
    else if (part->layer == TRACE_BACKGROUND)
        fputs("the background", out);
    else
        fputs(view_layer_words((view_layer)part->layer), out);
}

void trace_print(FILE *out, const trace *t)
{
    const size_t most = t->count < TRACE_TOLD ? t->count : TRACE_TOLD;
    uint64_t told = 0;
    fprintf(out, "%" PRIu64 " pixel%s: ", t->pixels, plural(t->pixels));
    for (int text = 0; text < 2; text++) /* what is written says what is drawn: it comes last */
        for (size_t i = 0; i < most; i++) {
            if ((t->parts[i].layer == LAYER_TEXT) != text)
                continue;
            fprintf(out, "%s%" PRIu64 " of ", told ? ", " : "", t->parts[i].pixels);
            trace_print_part(out, &t->parts[i]);
            told += t->parts[i].pixels;
        }
    if (told < t->pixels)
        fprintf(out, ", %" PRIu64 " of others", t->pixels - told);
}
