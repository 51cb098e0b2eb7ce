/* cause_value.c - see cause_value.h. */
#include "cause_value.h"
#include "number.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

cause_value cause_whole(uint64_t whole)
{
    return (cause_value){.type = VALUE_WHOLE, .whole = whole};
}

cause_value cause_number(double number)
{
    return (cause_value){.type = VALUE_NUMBER, .numbers = {number}};
}

cause_value cause_word(const char *word)
{
    cause_value value = {.type = VALUE_WORD};
    snprintf(value.word, sizeof value.word, "%s", word);
    return value;
}

cause_value cause_place(const double place[3])
{
    return (cause_value){.type = VALUE_PLACE, .numbers = {place[0], place[1], place[2]}};
}

cause_value cause_box(const octree_box *box)
{
    return cause_ends(VALUE_BOX, box->min, box->max);
}

cause_value cause_ends(cause_type type, const double from[3], const double to[3])
{
    return (cause_value){.type = type, .numbers = {from[0], from[1], from[2], to[0], to[1], to[2]}};
}

int cause_order_numbers(const double *a, const double *b, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const int minus[2] = {signbit(a[i]) != 0, signbit(b[i]) != 0};
        if (a[i] != b[i] || minus[0] != minus[1])
            return a[i] < b[i] || (a[i] == b[i] && minus[0]) ? -1 : 1;
    }
    return 0;
}

bool cause_same_value(const cause_value *a, const cause_value *b)
{
    return a->type == b->type && a->whole == b->whole && strcmp(a->word, b->word) == 0 &&
           cause_order_numbers(a->numbers, b->numbers, 6) == 0;
}

static void print_number(FILE *out, double number)
{
    char text[NUMBER_TEXT];
    number_print(number, text);
    fputs(text, out);
}

static void print_place(FILE *out, const double place[3])
{
    for (int axis = 0; axis < 3; axis++) {
        fputs(axis ? ", " : "(", out);
        print_number(out, place[axis]);
    }
    fputc(')', out);
}

void cause_print_value(FILE *out, const cause_value *value)
{
    switch (value->type) {
    case VALUE_WHOLE:
        fprintf(out, "%" PRIu64, value->whole);
        break;
    case VALUE_NUMBER:
        print_number(out, value->numbers[0]);
        break;
    case VALUE_PLACE:
        print_place(out, value->numbers);
        break;
    case VALUE_SEGMENT:
    case VALUE_BOX:
        print_place(out, value->numbers);
        fputs(" to ", out);
        print_place(out, value->numbers + 3);
        break;
    default:
        fputs(value->word, out);
        break;
    }
}
