/* job_link.c - see job_link.h. */
#include "job_link.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* What goes before the bytes of a message. */
typedef struct head {
    message_kind kind;
    film_step step;
    size_t size;
} head;

bool link_open(int ends[2], octreel_error *error)
{
    return socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0 ||
           error_set(error, "a link to another process cannot be made: %s", strerror(errno));
}

void link_end(int link)
{
    shutdown(link, SHUT_WR);
}

/* No signal where nobody hears it: a job may have died, and so may who started it. */
bool link_tell(int link, const void *bytes, size_t size)
{
    for (const char *at = bytes; size > 0;) {
        const ssize_t written = send(link, at, size, MSG_NOSIGNAL);
        if (written < 0 && errno != EINTR)
            return false;
        at += written > 0 ? written : 0;
        size -= written > 0 ? (size_t)written : 0;
    }
    return true;
}

bool link_hear(int link, void *bytes, size_t size)
{
    for (char *at = bytes; size > 0;) {
        const ssize_t got = read(link, at, size);
        if (got == 0 || (got < 0 && errno != EINTR))
            return false;
        at += got > 0 ? got : 0;
        size -= got > 0 ? (size_t)got : 0;
    }
    return true;
}

bool link_stirs(int link, int milliseconds)
{
    struct pollfd asked = {.fd = link, .events = POLLIN};
    return poll(&asked, 1, milliseconds) > 0;
}

bool link_tell_message(int link, message_kind kind, const film_step *step, const void *bytes, size_t size)
{
    const head h = {.kind = kind, .step = step ? *step : (film_step){0}, .size = size};
    return link_tell(link, &h, sizeof h) && link_tell(link, bytes, size);
}

static bool receive(int link, message *m)
{
    head h;
    if (!link_hear(link, &h, sizeof h))
        return false;
    char *room = realloc(m->bytes, h.size + 1);
    if (!room)
        return false;
    m->kind = h.kind;
    m->step = h.step;
    m->size = h.size;
    m->bytes = room;
    m->step.line = room;
    return link_hear(link, room, h.size);
}

void link_hear_message(int link, message *m)
{
    if (!receive(link, m))
        m->kind = MESSAGE_NONE;
}
