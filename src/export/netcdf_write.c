/* Writes classic netCDF files. All numbers have their highest byte first. */
#include "netcdf_write.h"

#include "base/memory.h"

/* Tags of the lists in the header of a netCDF file, as the format defines them. CHUNK: number of values that are
 * converted and written at a time. */
enum { TAG_DIMENSIONS = 10, TAG_ARRAYS = 11, TAG_ATTRIBUTES = 12, CHUNK = 1024 };

static int64_t type_size(enum netcdf_type type) { return type == NETCDF_CHAR ? 1 : type == NETCDF_DOUBLE ? 8 : 4; }

static void name_set(char *to, const char *name, int number)
{
    if (number > 0)
        snprintf(to, NETCDF_NAME, "%s%d", name, number);
    else
        snprintf(to, NETCDF_NAME, "%s", name);
}

int netcdf_define_dimension(struct netcdf_writer *w, const char *name, int name_suffix, int64_t length)
{
    GROW("netcdf.dimensions", w->dimension, w->dimensions + 1);
    name_set(w->dimension[w->dimensions].name, name, name_suffix);
    w->dimension[w->dimensions].length = length;
    return w->dimensions++;
}

void netcdf_define_array(struct netcdf_writer *w, const char *name, int name_suffix, enum netcdf_type type,
                         int dimension_count, const int *dimension, const char *attribute_name,
                         const char *attribute_text)
{
    GROW("netcdf.arrays", w->array, w->arrays + 1);
    struct netcdf_array *a = &w->array[w->arrays++];
    *a = (struct netcdf_array){
        .type = type, .ranks = dimension_count, .attribute = attribute_name, .text = attribute_text};
    name_set(a->name, name, name_suffix);
    for (int k = 0; k < dimension_count; k++) a->dimension[k] = dimension[k];
}

/* ---- the header -------------------------------------------------------------------------------------------------- */

/* Returns true if the first dimension of the array a of w is that of records (length 0), so that the array has a part
 * in every record of the file. */
static bool is_over_records(const struct netcdf_writer *w, const struct netcdf_array *a)
{
    return w->dimension[a->dimension[0]].length == 0;
}

/* Returns the size of the array a of w [byte], rounded up to a multiple of four. For an array over records it is the
 * size of its part in one record. */
static int64_t array_size(const struct netcdf_writer *w, const struct netcdf_array *a)
{
    int64_t size = type_size(a->type);
    for (int k = 0; k < a->ranks; k++)
        if (w->dimension[a->dimension[k]].length > 0) size *= w->dimension[a->dimension[k]].length;
    return (size + 3) / 4 * 4;
}

static void put_bytes(struct netcdf_writer *w, const void *bytes, int64_t n)
{
    GROW("netcdf.header", w->header, w->length + n);
    array_copy(w->header + w->length, bytes, n, 1);
    w->length += n;
}

static void put_number(struct netcdf_writer *w, uint64_t value, int bytes)
{
    uint8_t text[8];
    for (int k = 0; k < bytes; k++) text[k] = (uint8_t)(value >> 8 * (bytes - 1 - k));
    put_bytes(w, text, bytes);
}

/* Appends the length of a text and the text to the header in w, filled up with zeros to a multiple of four bytes. */
static void put_text(struct netcdf_writer *w, const char *text)
{
    static const char zeros[3];
    const int64_t n = (int64_t)strlen(text);
    put_number(w, (uint64_t)n, 4);
    put_bytes(w, text, n);
    put_bytes(w, zeros, (4 - n % 4) % 4);
}

/* Appends the head of a list to the header in w: the tag `tag`, which states the kind of list, and the number n of
 * elements. For an empty list two zeros are appended. */
static void put_list_head(struct netcdf_writer *w, int tag, int n)
{
    put_number(w, n > 0 ? (uint64_t)tag : 0, 4);
    put_number(w, (uint64_t)n, 4);
}

static void put_attribute(struct netcdf_writer *w, const struct netcdf_attribute *a)
{
    const float single = (float)a->value;
    uint32_t bits = (uint32_t)(int32_t)a->value;
    if (a->type == NETCDF_FLOAT) memcpy(&bits, &single, sizeof bits);
    put_text(w, a->name);
    put_number(w, a->text ? NETCDF_CHAR : a->type, 4);
    if (a->text) {
        put_text(w, a->text);
        return;
    }
    put_number(w, 1, 4);
    put_number(w, bits, 4);
}

/* Builds the header of the netCDF file in w, with the definitions of dimensions, attributes and arrays. first: length
 * of the header [byte], which is the position of the first array in the file. */
static void header_build(struct netcdf_writer *w, int64_t first)
{
    int64_t at[2] = {first, first}; /* position of the next array of one length; over records */
    w->length = 0;
    for (int k = 0; k < w->arrays; k++)
        if (!is_over_records(w, &w->array[k])) at[1] += array_size(w, &w->array[k]);
    put_bytes(w, "CDF\2", 4);
    put_number(w, (uint64_t)w->records, 4);
    put_list_head(w, TAG_DIMENSIONS, w->dimensions);
    for (int k = 0; k < w->dimensions; k++) {
        put_text(w, w->dimension[k].name);
        put_number(w, (uint64_t)w->dimension[k].length, 4);
    }
    put_list_head(w, TAG_ATTRIBUTES, w->attributes);
    for (int k = 0; k < w->attributes; k++) put_attribute(w, &w->attribute[k]);
    put_list_head(w, TAG_ARRAYS, w->arrays);
    for (int k = 0; k < w->arrays; k++) {
        const struct netcdf_array *a = &w->array[k];
        int64_t *place = &at[is_over_records(w, a)];
        put_text(w, a->name);
        put_number(w, (uint64_t)a->ranks, 4);
        for (int d = 0; d < a->ranks; d++) put_number(w, (uint64_t)a->dimension[d], 4);
        put_list_head(w, TAG_ATTRIBUTES, a->attribute != NULL);
        if (a->attribute) put_attribute(w, &(struct netcdf_attribute){.name = a->attribute, .text = a->text});
        put_number(w, a->type, 4);
        put_number(w, (uint64_t)array_size(w, a), 4);
        put_number(w, (uint64_t)*place, 8);
        *place += array_size(w, a);
    }
}

void netcdf_write_header(struct netcdf_writer *w)
{
    header_build(w, 0); /* its length does not depend on the positions in it */
    header_build(w, w->length);
    fwrite(w->header, 1, (size_t)w->length, w->to);
}

void netcdf_free(struct netcdf_writer *w)
{
    memory_free(w->dimension);
    memory_free(w->array);
    memory_free(w->header);
    *w = (struct netcdf_writer){0};
}

/* ---- numbers ----------------------------------------------------------------------------------------------------- */

void netcdf_write_reals(struct netcdf_writer *w, int64_t n, const real *value)
{
    uint8_t chunk[CHUNK][8];
    for (int64_t first = 0; first < n; first += CHUNK) {
        const int64_t count = n - first < CHUNK ? n - first : CHUNK;
        for (int64_t k = 0; k < count; k++) {
            uint64_t bits;
            memcpy(&bits, &value[first + k], sizeof bits);
            for (int b = 0; b < 8; b++) chunk[k][b] = (uint8_t)(bits >> 8 * (7 - b));
        }
        fwrite(chunk, 8, (size_t)count, w->to);
    }
    w->pending += 8 * n;
}

void netcdf_write_integers(struct netcdf_writer *w, int64_t n, const int32_t *value)
{
    for (int64_t k = 0; k < n; k++) {
        const uint32_t bits = (uint32_t)value[k];
        for (int b = 0; b < 4; b++) fputc((int)(bits >> 8 * (3 - b) & 255), w->to);
    }
    w->pending += 4 * n;
}

void netcdf_write_text_row(struct netcdf_writer *w, const char *text, int row_bytes)
{
    const int length = (int)strlen(text);
    for (int k = 0; k < row_bytes; k++) fputc(k < length ? text[k] : 0, w->to);
    w->pending += row_bytes;
}

void netcdf_end_array(struct netcdf_writer *w)
{
    for (; w->pending % 4 != 0; w->pending++) fputc(0, w->to);
    w->pending = 0;
}
