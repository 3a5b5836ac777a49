/* Composes an HTML page: head, style, body, arrays in base64, JSON and script. Texts of users are in the JSON alone,
 * with `<` escaped, so that no text of an input file is read as HTML. The content security policy in the head forbids
 * the page to load or send anything. */
#include "page.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"
#include "output/page_file.h"
#include "report_page.h"

static const struct {
    const char *name;
    size_t size;
} types[PAGE_TYPES] = {
    [PAGE_U8] = {"u8", 1},   [PAGE_U16] = {"u16", 2}, [PAGE_I16] = {"i16", 2},
    [PAGE_F32] = {"f32", 4}, [PAGE_PNG] = {"png", 1}, [PAGE_SVG] = {"svg", 1},
};

status html_page_begin_in_memory(struct html_page *p)
{
    *p = (struct html_page){.json = {.depth = 1}};
    p->json.file = memory_stream_open(&p->text, &p->text_length);
    p->arrays = memory_stream_open(&p->array_text, &p->array_length);
    if (!p->json.file || !p->arrays) {
        html_page_release(p);
        return status_set(FAILED, "report: out of memory");
    }
    fputc('{', p->json.file);
    return OK;
}

/* Writes bytes[length] to the file `to` in base64 (RFC 4648). */
static void write_base64(FILE *to, const unsigned char *bytes, size_t length)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t k = 0; k < length; k += 3) {
        const size_t have = length - k < 3 ? length - k : 3;
        uint32_t bits = 0;
        char four[4];
        for (size_t b = 0; b < 3; b++) bits = bits << 8 | (b < have ? bytes[k + b] : 0);
        for (size_t d = 0; d < 4; d++) four[d] = d <= have ? digit[bits >> (18 - 6 * d) & 63] : '=';
        fwrite(four, 1, sizeof four, to);
    }
}

void html_page_add_array(struct html_page *p, const char *key, enum page_type type, const void *values,
                         int64_t value_count)
{
    json_begin_object_or_list(&p->json, key, '{');
    json_write_integer(&p->json, "array", p->count);
    json_write_text(&p->json, "type", types[type].name);
    json_write_integer(&p->json, "length", value_count);
    json_end_object_or_list(&p->json, '}');
    fprintf(p->arrays, "<script type=\"text/plain\" id=\"array%d\">", p->count++);
    write_base64(p->arrays, values, (size_t)value_count * types[type].size);
    fputs("</script>\n", p->arrays);
}

status html_page_add_picture(struct html_page *p, const char *entry_name, enum page_type format, const char *path)
{
    char *bytes;
    size_t length;
    TRY(file_read_whole(path, &bytes, &length));
    html_page_add_array(p, entry_name, format, bytes, (int64_t)length);
    memory_free(bytes);
    return OK;
}

void html_page_add_text_file(struct html_page *p, const char *entry_name, const char *folder, const char *file_name)
{
    char *text;
    size_t length;
    const struct path path = path_join(folder, file_name);
    if (!path_is_file(path.text) || file_read_whole(path.text, &text, &length) != OK) return;
    json_write_text(&p->json, entry_name, text);
    memory_free(text);
}

void html_page_add_time(struct html_page *p, const char *entry_name, time_t moment)
{
    char text[64];
    struct tm tm;
    if (gmtime_r(&moment, &tm) && strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &tm) > 0)
        json_write_text(&p->json, entry_name, text);
}

/* Writes `text` to the file `to` as the content of an HTML element, with < and & escaped. */
static void write_escaped(FILE *to, const char *text)
{
    for (const char *c = text; *c; c++) {
        if (*c == '<' || *c == '&')
            fputs(*c == '<' ? "&lt;" : "&amp;", to);
        else
            fputc(*c, to);
    }
}

/* Writes the JSON text[length] to the file `to` with every < escaped, so that no string in it can end a <script>
 * element. In JSON, < occurs in strings only. */
static void write_json(FILE *to, const char *text, size_t length)
{
    for (size_t k = 0; k < length; k++) {
        if (text[k] == '<')
            fputs("\\u003c", to);
        else
            fputc(text[k], to);
    }
}

static void write_page(FILE *to, const struct html_page *p, const char *title)
{
    fputs(PAGE_BEGINNING, to);
    fputs("<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
          "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
          to);
    write_escaped(to, title);
    fputs("</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n", to);
    fputs(page_css, to);
    fputs("</style></head>\n", to);
    fputs(page_html, to);
    fwrite(p->array_text, 1, p->array_length, to);
    fputs("<script type=\"application/json\" id=\"page\">", to);
    write_json(to, p->text, p->text_length);
    fputs("</script>\n<script>\n\"use strict\";\n", to);
    fputs(page_js, to);
    fputs("</script>\n</body></html>\n", to);
}

/* Closes the streams of JSON and arrays of the page p. Returns FAILED, with a message, if there was no memory for
 * them. */
static status page_close(struct html_page *p)
{
    fputs("\n}\n", p->json.file);
    const bool json = fclose(p->json.file) == 0, arrays = fclose(p->arrays) == 0;
    p->json.file = p->arrays = NULL;
    return json && arrays ? OK : status_set(FAILED, "report: out of memory");
}

status html_page_complete_and_write_file(struct html_page *p, const char *path, const char *title, int64_t *file_size)
{
    char *text = NULL;
    size_t length = 0;
    TRY(page_close(p));
    FILE *to = memory_stream_open(&text, &length);
    if (!to) return status_set(FAILED, "report: out of memory");
    write_page(to, p, title);
    const bool whole = fclose(to) == 0;
    *file_size = (int64_t)length;
    const status written = whole ? file_write_whole(path, text, length) : status_set(FAILED, "report: out of memory");
    free(text);
    return written;
}

void html_page_release(struct html_page *p)
{
    if (p->json.file) fclose(p->json.file);
    if (p->arrays) fclose(p->arrays);
    free(p->text);
    free(p->array_text);
    *p = (struct html_page){0};
}
