/* sentence.c - see sentence.h. */
#include "sentence.h"

#include <stdlib.h>

bool sentence_begin(sentence *s)
{
    *s = (sentence){0};
    s->stream = open_memstream(&s->text, &s->size);
    return s->stream != NULL;
}

bool sentence_end(sentence *s, char **text)
{
    const bool whole = s->stream && !ferror(s->stream);
    const bool ok = s->stream && fclose(s->stream) == 0 && whole;
    *text = ok && s->size ? s->text : NULL;
    if (!*text)
        free(s->text);
    return ok;
}
