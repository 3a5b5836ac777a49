/* Reads classic netCDF files by their specification (NetCDF User's Guide, "File format specifications": CDF-1, CDF-2,
 * CDF-5). Numbers have their highest byte first. */
#include <stdio.h>

#include "base/memory.h"
#include "exodus_parts.h"

/* Tags of the lists in the header, as the format defines them. */
enum { TAG_DIMENSIONS = 10, TAG_ARRAYS = 11, TAG_ATTRIBUTES = 12 };

/* Size of a number of each type of the format [byte], by enum exodus_type. */
static const int type_bytes[EXODUS_TYPES] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};

/* The header of a classic netCDF file while it is read. */
struct header {
    struct exodus_file *f;
    int64_t at;  /* position of the next byte */
    int version; /* version of the format: 1, 2 or 5 */
    bool good;   /* false: the header ends too early or has invalid contents */
};

/* Reads an unsigned number of `bytes` bytes at the reading position h->at, which advances. Returns 0, and sets h->good
 * to false, at the end of the file. */
static uint64_t next_bytes(struct header *h, int bytes)
{
    uint64_t value = 0;
    h->good = h->good && h->f->length - h->at >= bytes;
    for (int k = 0; k < bytes && h->good; k++) value = value << 8 | h->f->text[h->at++];
    return value;
}

/* Reads the number of items that follow at the reading position of h, each of at least `least` bytes. Sets h->good to
 * false and returns 0 if the file is too short for them. */
static int64_t next_count(struct header *h, int64_t least)
{
    const uint64_t value = next_bytes(h, h->version == 5 ? 8 : 4);
    h->good = h->good && value <= (uint64_t)(h->f->length / least);
    return h->good ? (int64_t)value : 0;
}

/* Reads the length of a dimension at the reading position of h. It may exceed the size of the file, since no array need
 * have this dimension. */
static int64_t next_length(struct header *h)
{
    const uint64_t value = next_bytes(h, h->version == 5 ? 8 : 4);
    h->good = h->good && value <= INT32_MAX;
    return h->good ? (int64_t)value : 0;
}

/* Advances the reading position of h by `bytes` bytes and the padding up to a multiple of four. Sets h->good to false
 * if the file ends before. */
static void skip_padded(struct header *h, int64_t bytes)
{
    const int64_t padded = (bytes + 3) / 4 * 4;
    h->good = h->good && bytes >= 0 && padded <= h->f->length - h->at;
    if (h->good) h->at += padded;
}

/* Copies the next `length` bytes of the header h to text[NAME_MAX_LENGTH], without trailing blanks. Longer texts are
 * cut off. */
static void next_text(struct header *h, int64_t length, char *text)
{
    const int64_t from = h->at;
    skip_padded(h, length);
    const size_t kept = !h->good ? 0 : length < NAME_MAX_LENGTH ? (size_t)length : NAME_MAX_LENGTH - 1;
    memcpy(text, h->f->text + (h->good ? from : 0), kept);
    text[kept] = '\0';
    exodus_text_make_printable(text);
}

/* Reads a name, preceded by its length, from the header h into text[NAME_MAX_LENGTH]. */
static void next_name(struct header *h, char *text) { next_text(h, next_count(h, 1), text); }

/* Reads the tag and the length of a list, and returns the length. An absent list has the tag 0 and the length 0.
 * Sets h->good to false if the tag is neither `tag` nor that of an absent list. */
static int64_t next_list(struct header *h, uint64_t tag)
{
    const uint64_t found = next_bytes(h, 4);
    const int64_t n = next_count(h, 8);
    h->good = h->good && (found == tag || (found == 0 && n == 0));
    return h->good ? n : 0;
}

/* Reads a list of attributes from the header h. elements[NAME_MAX_LENGTH]: receives the value of the attribute
 * elem_type, "" if there is none. */
static void next_attributes(struct header *h, char *elements)
{
    const int64_t n = next_list(h, TAG_ATTRIBUTES);
    elements[0] = '\0';
    for (int64_t k = 0; k < n && h->good; k++) {
        char name[NAME_MAX_LENGTH];
        next_name(h, name);
        const uint64_t type = next_bytes(h, 4);
        h->good = h->good && type >= EXODUS_BYTE && type < EXODUS_TYPES;
        const int64_t count = next_count(h, 1);
        if (!h->good) return;
        if (type == EXODUS_CHAR && strcmp(name, "elem_type") == 0)
            next_text(h, count, elements);
        else
            skip_padded(h, count * type_bytes[type]);
    }
}

/* Reads the list of dimensions, their names and lengths, into h->f->dimension. */
static void dimensions_read(struct header *h)
{
    const int64_t n = next_list(h, TAG_DIMENSIONS);
    GROW("exodus.dimensions", h->f->dimension, n);
    for (; h->f->dimensions < n && h->good; h->f->dimensions++) {
        struct exodus_dimension *d = &h->f->dimension[h->f->dimensions];
        next_name(h, d->name);
        d->length = next_length(h);
    }
}

/* Reads the description of one array. Appends it to h->f->array if the array has one or two dimensions, neither of
 * which is the unlimited dimension of records. */
static void header_array(struct header *h)
{
    struct exodus_array a = {.extent = {1, 1}};
    next_name(h, a.name);
    const int64_t ranks = next_count(h, 4);
    bool kept = ranks == 1 || ranks == 2;
    for (int64_t k = 0; k < ranks && h->good; k++) {
        const int64_t id = next_length(h);
        h->good = h->good && id < h->f->dimensions;
        if (!h->good) return;
        const int64_t length = h->f->dimension[id].length;
        kept = kept && length > 0;
        if (k < 2) a.extent[k] = length;
    }
    next_attributes(h, a.elements);
    const uint64_t type = next_bytes(h, 4);
    next_bytes(h, h->version == 5 ? 8 : 4); /* its size, which follows from its shape */
    const uint64_t at = next_bytes(h, h->version == 1 ? 4 : 8);
    h->good = h->good && type >= EXODUS_BYTE && type < EXODUS_TYPES && at <= INT64_MAX;
    if (!h->good || !kept) return;
    a.type = (enum exodus_type)type, a.at = (int64_t)at;
    GROW("exodus.arrays", h->f->array, h->f->arrays + 1);
    h->f->array[h->f->arrays++] = a;
}

/* Returns REFUSED, with a message, if an array of f ends beyond the end of the file. */
static status arrays_check(const struct exodus_file *f)
{
    for (int64_t k = 0; k < f->arrays; k++) {
        const struct exodus_array *a = &f->array[k];
        const int64_t bytes = a->extent[0] * a->extent[1]; /* both fit in 32 bits */
        if (a->at <= f->length && bytes <= (f->length - a->at) / type_bytes[a->type]) continue;
        return status_set(REFUSED,
                          "%s: array %s should have %lld x %lld numbers, but the file is cut off; write it again",
                          f->path, a->name, (long long)a->extent[0], (long long)a->extent[1]);
    }
    return OK;
}

status exodus_classic_open(struct exodus_file *f)
{
    char unused[NAME_MAX_LENGTH];
    struct header h = {.f = f, .at = 4, .version = f->text[3], .good = true};
    next_bytes(&h, h.version == 5 ? 8 : 4); /* number of records */
    dimensions_read(&h);
    next_attributes(&h, unused);
    const int64_t n = next_list(&h, TAG_ARRAYS);
    for (int64_t k = 0; k < n && h.good; k++) header_array(&h);
    if (!h.good)
        return status_set(
            REFUSED, "%s: the header of this netCDF file is cut off or damaged near byte %lld; write the file again",
            f->path, (long long)h.at);
    return arrays_check(f);
}

void exodus_classic_read_array(const struct exodus_file *f, const struct exodus_array *array, int64_t count,
                               real *real_value, int64_t *whole_value)
{
    const int bytes = type_bytes[array->type];
    const bool is_signed = array->type <= EXODUS_INT || array->type == EXODUS_INT64;
    for (int64_t k = 0; k < count; k++) {
        const uint8_t *from = f->text + array->at + k * bytes;
        uint64_t bits = 0;
        for (int b = 0; b < bytes; b++) bits = bits << 8 | from[b];
        const int unused = 64 - 8 * bytes;
        const int64_t whole = is_signed ? (int64_t)(bits << unused) >> unused : (int64_t)bits;
        const uint32_t low = (uint32_t)bits;
        float single;
        real value;
        memcpy(&single, &low, sizeof single);
        memcpy(&value, &bits, sizeof value);
        if (array->type == EXODUS_FLOAT) value = single;
        if (array->type != EXODUS_FLOAT && array->type != EXODUS_DOUBLE) value = (real)whole;
        if (real_value)
            real_value[k] = value;
        else
            whole_value[k] = whole;
    }
}
