/* SPDX-License-Identifier: MIT */
/* frame_list.c - reads lists of frame names. */
#include "frame_list.h"
#include "array.h"
#include "error.h"
#include "file.h"
#include "text.h"

#include <stdlib.h>
#include <string.h>

bool frame_list_add(frame_list *list, const char *name, size_t line, octreel_error *error)
{
    if (!array_grow(&list->frames, list->count + 1, &list->room, sizeof *list->frames))
        return error_no_memory(error);
    list->frames[list->count++] = (listed_frame){name, line};
    return true;
}

bool frame_list_read(frame_list *list, const char *path, octreel_error *error)
{
    size_t size, before = list->count, number = 0;
    if (!file_read_whole(path, &list->text, &size, error))
        return false;
    list->text[size] = 0;
    if (strlen(list->text) < size)
        return error_set(error, "%s: contains a zero byte, so it is not a text file", file_display_name(path));
    char *at = list->text;
    for (char *line; (line = text_next_line(&at));) {
        number++;
        if (*line && !frame_list_add(list, line, number, error))
            return false;
    }
    return list->count > before || error_set(error, "%s: contains no name of a frame", file_display_name(path));
}

void frame_list_release(frame_list *list)
{
    free(list->frames);
    free(list->text);
    *list = (frame_list){0};
}
