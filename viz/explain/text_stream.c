/* text_stream.c - see text_stream.h. */
#include "text_stream.h"

#include <stdlib.h>

bool text_stream_begin(text_stream *s)
{
    *s = (text_stream){0};
    s->stream = open_memstream(&s->text, &s->size);
    return s->stream != NULL;
}

bool text_stream_end(text_stream *s, char **text)
{
    const bool whole = s->stream && !ferror(s->stream);
    const bool ok = s->stream && fclose(s->stream) == 0 && whole;
    *text = ok && s->size ? s->text : NULL;
    if (!*text)
        free(s->text);
    return ok;
}
