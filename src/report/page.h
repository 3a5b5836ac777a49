/* Declares an HTML report while it is composed: a JSON text that describes it, and arrays of numbers in base64 to which
 * the JSON refers. */
#ifndef CLEAVE_PAGE
#define CLEAVE_PAGE

#include <stdio.h>
#include <time.h>

#include "output/json.h"

/* Types of the elements of arrays in a page, all little-endian; PAGE_PNG, PAGE_SVG: bytes of a file of
 * this format. */
enum page_type { PAGE_U8, PAGE_U16, PAGE_I16, PAGE_F32, PAGE_PNG, PAGE_SVG, PAGE_TYPES };

/* A page of HTML while it is composed in memory: a JSON text that describes it, and arrays of numbers to which the JSON
 * refers. */
struct html_page {
    struct json json;    /* describes the page; its file is a stream in memory */
    char *text;          /* of the JSON */
    size_t text_length;  /* length of the JSON [byte] */
    FILE *arrays;        /* stream in memory of one <script> element for each array */
    char *array_text;    /* text of these elements */
    size_t array_length; /* length of this text [byte] */
    int count;           /* number of arrays */
};

/* Initialises p, an empty page (HTML report) in memory, with an open JSON object to which entries are added. Returns
 * FAILED if there is no memory for it. Release p with html_page_release. */
status html_page_begin_in_memory(struct html_page *p);

/* Adds the array values[value_count] to the page p (HTML report): the values as encoded binary data, and a reference
 * {array, type, length} to them in the JSON text. type: type of the elements; key: name of the reference; NULL if the
 * reference is an element of a list. */
void html_page_add_array(struct html_page *p, const char *key, enum page_type type, const void *values,
                         int64_t value_count);

/* Adds the picture in the file `path` to the page p (HTML report) as an array of bytes, and a reference to this array
 * to the JSON text. format: PAGE_PNG or PAGE_SVG; entry_name: name of the reference; NULL if it is an element of a
 * list. Returns FAILED if the file cannot be read. */
status html_page_add_picture(struct html_page *p, const char *entry_name, enum page_type format, const char *path);

/* Adds the time `moment` to the JSON text of the page p (HTML report), in UTC to the minute. entry_name: name of the
 * entry. Adds nothing for a time that has no date in the calendar. */
void html_page_add_time(struct html_page *p, const char *entry_name, time_t moment);

/* Adds the text of the file `file_name` in `folder` to the JSON text of the page p (HTML report) as a string.
 * entry_name: name of the entry. Adds nothing if there is no such file. */
void html_page_add_text_file(struct html_page *p, const char *entry_name, const char *folder, const char *file_name);

/* Completes the page p (HTML report) and writes it to the file `path` under a temporary name, which is then renamed.
 * title: title of the window, without markup. Stores the size of the file in *file_size. Returns FAILED if the file
 * cannot be written, REFUSED, with a message, if it is an input of this command. */
status html_page_complete_and_write_file(struct html_page *p, const char *path, const char *title, int64_t *file_size);

/* Releases the texts and arrays of the composed page *p. */
void html_page_release(struct html_page *p);

#endif
