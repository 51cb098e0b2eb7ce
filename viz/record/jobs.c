/* SPDX-License-Identifier: MIT */
/* jobs.c - a recording by several processes. */
#include "jobs.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- Pipes -------------------------------------------------------------------------------------------------- */

/* No SIGPIPE where the other end is closed: the job, or the process that started it, may have died. */
static bool pipe_write(int pipe, const void *bytes, size_t size)
{
    for (const char *at = bytes; size > 0;) {
        const ssize_t written = send(pipe, at, size, MSG_NOSIGNAL);
        if (written < 0 && errno != EINTR)
            return false;
        at += written > 0 ? written : 0;
        size -= written > 0 ? (size_t)written : 0;
    }
    return true;
}

/* Exactly so many bytes. False when the other end has closed. */
static bool pipe_read(int pipe, void *bytes, size_t size)
{
    for (char *at = bytes; size > 0;) {
        const ssize_t got = read(pipe, at, size);
        if (got == 0 || (got < 0 && errno != EINTR))
            return false;
        at += got > 0 ? got : 0;
        size -= got > 0 ? (size_t)got : 0;
    }
    return true;
}

/* Whether within so many milliseconds there is something to read, or the other end has closed. */
static bool pipe_poll(int pipe, int milliseconds)
{
    struct pollfd asked = {.fd = pipe, .events = POLLIN};
    return poll(&asked, 1, milliseconds) > 0;
}

/* What a job writes: after each tick its step, followed by the bytes of its line. A job that fails writes `failed`,
 * followed by an octreel_error. Job 0 ends with the frame_checks of the recording. */
typedef struct message {
    film_step step;
    bool failed;
    size_t size; /* of the bytes */
} message;

static bool write_message(int pipe, message m, const void *bytes, size_t size)
{
    m.size = size;
    return pipe_write(pipe, &m, sizeof m) && pipe_write(pipe, bytes, size);
}

/* ---- A job -------------------------------------------------------------------------------------------------- */

typedef struct job {
    pid_t pid;
    int pipe; /* both ways: in the job its own end, in the process that started it the other */
    const film_options *options;
    uint64_t session; /* the digest of the session's file: all that a job is told, once that is written */
    bool told;
} job;

/* Wait until the job is told the session's digest, or stopped before. */
static void wait_for_session(job *self)
{
    if (!self->told && !pipe_read(self->pipe, &self->session, sizeof self->session))
        _exit(EXIT_SUCCESS);
    self->told = true;
}

static void learn_session(uint64_t *digest, void *context)
{
    job *self = context;
    wait_for_session(self);
    *digest = self->session;
}

/* Until the caller of the recording says so, or the process that started the job stops it or dies. */
static bool job_keeps_going(void *context)
{
    const job *self = context;
    const film_options *options = self->options;
    return (!options->keep_going || options->keep_going(options->context)) && !(self->told && pipe_poll(self->pipe, 0));
}

/* Sleep until the process that started the job has died, and die with it: the frame in hand has nobody who wants it.
 * Where it only stops the job it has not closed its end. */
static void *watch_starter(void *context)
{
    const job *self = context;
    struct pollfd asked = {.fd = self->pipe, .events = 0};
    while (poll(&asked, 1, -1) < 0 && errno == EINTR)
        continue;
    _exit(EXIT_FAILURE);
}

/* Without that thread the job notices after its frame. Signals go to the job itself. */
static void begin_watch(job *self)
{
    sigset_t all, before;
    pthread_t thread;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    if (pthread_create(&thread, NULL, watch_starter, self) == 0)
        pthread_detach(thread);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

static bool write_step(void *context, const film_step *step, octreel_error *error)
{
    job *self = context;
    wait_for_session(self); /* nobody reads before */
    return write_message(self->pipe, (message){.step = *step}, step->line, step->size) ||
           error_set(error, "nobody collects the ticks");
}

/* All that a job does. It leaves by _exit(): its memory goes with it, and what stdio has buffered is not its own. */
static _Noreturn void run_job(job *self, const recording *r, playback *p, const film_share *share)
{
    octreel_error error;
    setenv("LP_NUM_THREADS", "0", 0); /* the other cores have jobs of their own */
    draw_context_set_report(NULL);    /* the process that started it does */
    begin_watch(self);
    p->learn_session = learn_session; /* the first frame is drawn meanwhile */
    p->learn_context = self;
    const bool ok = recording_film(r, p, &error) && playback_run(p, share, write_step, job_keeps_going, self, &error);
    if (ok && share->index == 0)
        write_message(self->pipe, (message){.failed = false}, &p->checks, sizeof p->checks);
    else if (!ok)
        write_message(self->pipe, (message){.failed = true}, &error, sizeof error);
    _exit(ok ? EXIT_SUCCESS : EXIT_FAILURE);
}

/* ---- Jobs that film together -------------------------------------------------------------------------------- */

typedef struct job_pool {
    recording *recording;
    job *jobs;
    unsigned wanted, count; /* how many there are to be, and are */
    bool stopped;           /* no job is to begin another frame */
    char *bytes;            /* of the last message */
} job_pool;

static bool start_job(job_pool *pool, playback *p, octreel_error *error)
{
    int ends[2];
    recording *r = pool->recording;
    film_share share = r->share;
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
        return error_set(error, "a pipe to another process cannot be made: %s", strerror(errno));
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        for (unsigned i = 0; i < pool->count; i++)
            close(pool->jobs[i].pipe); /* a pipe ends when all copies of its other end are closed */
        share.index = pool->count;
        share.count = pool->wanted;
        run_job(&(job){.pipe = ends[1], .options = r->options}, r, p, &share);
    }
    const int reason = errno;
    close(ends[1]);
    if (pid > 0) {
        pool->jobs[pool->count++] = (job){.pid = pid, .pipe = ends[0], .options = r->options};
        return true;
    }
    close(ends[0]);
    return error_set(error, "a process cannot be started: %s", strerror(reason));
}

/* Let each job finish the frame in hand. */
static void stop_jobs(job_pool *pool)
{
    for (unsigned i = 0; i < pool->count && !pool->stopped; i++)
        shutdown(pool->jobs[i].pipe, SHUT_WR);
    pool->stopped = true;
}

/* Read the next message of a job. Meanwhile the caller may want to stop. */
static bool read_message(job_pool *pool, const job *j, message *m)
{
    enum { PATIENCE = 50 }; /* milliseconds */
    const film_options *options = pool->recording->options;
    while (!pool->stopped) {
        if (options->keep_going && !options->keep_going(options->context))
            stop_jobs(pool);
        else if (pipe_poll(j->pipe, PATIENCE))
            break;
    }
    free(pool->bytes);
    pool->bytes = NULL;
    return pipe_read(j->pipe, m, sizeof *m) && (pool->bytes = malloc(m->size + 1)) &&
           pipe_read(j->pipe, pool->bytes, m->size);
}

/* How a job ended before its time. True when it was stopped. */
static bool explain_end(job_pool *pool, unsigned i, octreel_error *error)
{
    int status = 0;
    pid_t ended;
    while ((ended = waitpid(pool->jobs[i].pid, &status, 0)) < 0 && errno == EINTR)
        continue;
    pool->jobs[i].pid = 0;
    if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS)
        return true;
    if (ended > 0 && WIFSIGNALED(status))
        return error_set(error, "job %u of %u was killed by signal %d (%s); --resume films what is missing", i + 1,
                         pool->count, WTERMSIG(status), strsignal(WTERMSIG(status)));
    return error_set(error, "job %u of %u ended early, with status %d; --resume films what is missing", i + 1,
                     pool->count, WEXITSTATUS(status));
}

/* Read each tick from the job that films it, until all are there or the recording is stopped. */
static bool collect(job_pool *pool, octreel_error *error)
{
    recording *r = pool->recording;
    film_share share = r->share;
    message last;
    share.count = pool->count;
    for (uint64_t tick = r->share.first; tick < r->share.last; tick++) {
        message m;
        const unsigned i = (unsigned)share_find_job(&share, tick / r->options->every, r->options->every);
        if (!read_message(pool, &pool->jobs[i], &m))
            return explain_end(pool, i, error);
        if (m.failed) {
            memcpy(error, pool->bytes, sizeof *error);
            return false;
        }
        m.step.line = pool->bytes;
        if (!recording_add(r, &m.step, error))
            return false;
    }
    if (!read_message(pool, &pool->jobs[0], &last))
        return explain_end(pool, 0, error);
    memcpy(&r->summary->checks, pool->bytes, sizeof r->summary->checks);
    return true;
}

/* Stop the jobs, and wait until they have ended: what they still write must be read, or they would wait. */
static void end_jobs(job_pool *pool)
{
    char ignored;
    stop_jobs(pool);
    for (unsigned i = 0; i < pool->count; i++) {
        while (pipe_read(pool->jobs[i].pipe, &ignored, 1))
            continue;
        close(pool->jobs[i].pipe);
        while (pool->jobs[i].pid > 0 && waitpid(pool->jobs[i].pid, NULL, 0) < 0 && errno == EINTR)
            continue;
    }
    free(pool->bytes);
    free(pool->jobs);
}

/* While the jobs open what draws, this process writes the files that come first. It draws nothing itself. */
static bool begin(job_pool *pool, playback *p, octreel_error *error)
{
    while (pool->count < pool->wanted)
        if (!start_job(pool, p, error))
            return false;
    octree_game_destroy(p->game); /* each job has it, and this process plays nothing */
    p->game = NULL;
    const bool begun = recording_film(pool->recording, p, error) && recording_begin(pool->recording, p, error);
    picture_close(&p->picture);
    return begun;
}

/* A job that has died is noticed when it is read; one that lives would wait for ever. */
static bool tell_jobs(const job_pool *pool, uint64_t session, octreel_error *error)
{
    for (unsigned i = 0; i < pool->count; i++)
        if (!pipe_write(pool->jobs[i].pipe, &session, sizeof session) && errno != EPIPE && errno != ECONNRESET)
            return error_set(error, "job %u of %u cannot be told what to film: %s", i + 1, pool->count,
                             strerror(errno));
    return true;
}

bool film_by_jobs(recording *r, playback *p, unsigned jobs, octreel_error *error)
{
    job_pool pool = {.recording = r, .wanted = jobs, .jobs = calloc(jobs, sizeof *pool.jobs)};
    if (!pool.jobs)
        return error_no_memory(error);
    const bool begun = begin(&pool, p, error);
    const bool ok = begun && tell_jobs(&pool, p->session_digest, error) && collect(&pool, error);
    end_jobs(&pool);
    return begun ? recording_end(r, ok, error) : false;
}
