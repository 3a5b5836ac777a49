/* Writes the page of a run from its results folder. Contents that a running or interrupted run lacks are left out. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt_cleanup.h"
#include "base/memory.h"
#include "film.h"
#include "output/history.h"
#include "output/output_files.h"
#include "output/summary_read.h"
#include "plot/scene_picture.h"
#include "report_parts.h"
#include "scene/scene_read.h"
#include "study/study.h"

/* FILM_BYTES, HISTORY_BYTES: largest sizes of the frames and of the history in a page [byte]; encoded in base64 they
 * are a third larger. PICTURE_PARTICLES: number of particles above which the scene is not drawn. */
enum { FILM_BYTES = 9 << 20, HISTORY_BYTES = 1 << 20, PICTURE_PARTICLES = 2000000 };

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Arguments of write_unit: the page, and the header of history.csv, which states units. */
struct units {
    struct html_page *page;
    const char *header;
};

/* Writes the unit of the result `key`, a number in summary.json, to the page if the result has a unit. context: pointer
 * to a struct units; value: value of the result, not used. It is called once for each result. */
static void write_unit(void *context, const char *key, double value)
{
    const struct units *u = context;
    char unit[UNIT_ROOM];
    (void)value;
    study_determine_unit_of_result(unit, sizeof unit, u->header, key);
    if (unit[0]) json_write_text(&u->page->json, key, unit);
}

static void write_figures(struct html_page *p, const char *folder, const char *header)
{
    struct units u = {p, header};
    struct stat s;
    const struct path summary = path_join(folder, "summary.json");
    html_page_add_text_file(p, "summary", folder, "summary.json");
    json_begin_object_or_list(&p->json, "units", '{');
    if (path_is_file(summary.text)) (void)summary_visit_numbers(folder, write_unit, &u);
    json_end_object_or_list(&p->json, '}');
    if (stat(summary.text, &s) == 0) html_page_add_time(p, "ended", s.st_mtime);
}

/* ---- history ----------------------------------------------------------------------------------------------------- */

/* Writes the columns of history.csv in `folder` in single precision to the page p. Of long histories it writes every
 * n-th line, so that they fit into HISTORY_BYTES, and the last line. header: first line of the file; "": there is no
 * file. Returns FAILED, with a message, if the file cannot be read. */
static status write_history(struct html_page *p, const char *folder, const char *header)
{
    struct history h;
    if (!header[0]) return OK;
    TRY(history_read(&h, folder));
    const int64_t most = HISTORY_BYTES / (4 * h.columns), stride = h.rows / most + 1;
    const int64_t rows = h.rows > 0 ? (h.rows - 1 + stride - 1) / stride + 1 : 0;
    float *column = NEW("report.column", rows, float);
    json_begin_object_or_list(&p->json, "history", '{');
    json_write_text(&p->json, "header", header);
    json_write_integer(&p->json, "listed", h.rows);
    json_write_integer(&p->json, "rows", rows);
    json_begin_object_or_list(&p->json, "columns", '[');
    for (int c = 0; c < h.columns; c++) {
        for (int64_t k = 0; k < rows; k++)
            column[k] = (float)history_value_at(&h, k < rows - 1 ? k * stride : h.rows - 1, c);
        html_page_add_array(p, NULL, PAGE_F32, column, rows);
    }
    json_end_object_or_list(&p->json, ']');
    json_end_object_or_list(&p->json, '}');
    memory_free(column);
    history_free(&h);
    return OK;
}

/* ---- scene ------------------------------------------------------------------------------------------------------- */

/* Writes the corners [m] of the pre-cracks of scene s to the JSON of the page p. */
static void write_pre_cracks(struct html_page *p, const struct scene *s)
{
    json_begin_object_or_list(&p->json, "cracks", '[');
    for (int k = 0; k < s->cracks; k++) {
        json_begin_object_or_list(&p->json, NULL, '[');
        for (int c = 0; c < s->crack[k].n; c++) {
            json_begin_object_or_list(&p->json, NULL, '[');
            for (int d = 0; d < s->dim; d++) json_write_rounded(&p->json, NULL, s->crack[k].corner[c][d], JSON_EXACT);
            json_end_object_or_list(&p->json, ']');
        }
        json_end_object_or_list(&p->json, ']');
    }
    json_end_object_or_list(&p->json, ']');
}

/* Writes the names of the materials and bodies of scene s to the JSON of the page p. */
static void write_names(struct html_page *p, const struct scene *s)
{
    json_begin_object_or_list(&p->json, "names", '{');
    json_begin_object_or_list(&p->json, "material", '[');
    for (int k = 0; k < s->materials + s->unused_materials; k++)
        json_write_text(&p->json, NULL, scene_find_material_by_number(s, k)->name);
    json_end_object_or_list(&p->json, ']');
    json_begin_object_or_list(&p->json, "body", '[');
    for (int k = 0; k < s->bodies; k++) json_write_text(&p->json, NULL, s->body[k].name);
    json_end_object_or_list(&p->json, ']');
    json_end_object_or_list(&p->json, '}');
}

/* Draws the scene to a temporary file beside the page and adds the picture to the page p. scene: path of the scene
 * file; path: path of the page. Returns FAILED or REFUSED, with the reason in the message, if the scene cannot be
 * drawn. */
static status write_picture(struct html_page *p, const char *scene, const char *path)
{
    struct path picture;
    struct plot_request r = {.format = PICTURE_PNG, .out = picture.text, .overwrite = true, .quiet = true};
    r.projection = (struct projection){.normal = -1, .camera = camera_isometric};
    if (snprintf(picture.text, sizeof picture.text, "%s" ASIDE_ENDING ".png", path) >= (int)sizeof picture.text - 20)
        return status_set(FAILED, "%s: the name is too long; choose a shorter one", path);
    unlink(picture.text); /* a link of this name is not followed */
    interrupt_cleanup_register(LEAVING_FRAME, picture.text, 0);
    status s = scene_draw_picture(scene, NULL, 0, &r);
    if (s == OK) s = html_page_add_picture(p, "picture", PAGE_PNG, picture.text);
    unlink(picture.text);
    interrupt_cleanup_register(LEAVING_FRAME, NULL, 0);
    return s;
}

/* Writes the names and pre-cracks of the scene s to the page p, and its picture. folder: folder of the run; particles:
 * number of particles in the first output frame; path: path of the page. */
static void write_scene(struct html_page *p, const char *folder, const struct scene *s, int64_t particles,
                        const char *path)
{
    json_write_text(&p->json, "name", s->name);
    json_write_integer(&p->json, "dim", s->dim);
    write_pre_cracks(p, s);
    write_names(p, s);
    const status drawn =
        particles > PICTURE_PARTICLES
            ? status_set(REFUSED, "the scene has more than two million particles, too many for a picture")
            : write_picture(p, path_join(folder, "scene.yaml").text, path);
    if (drawn != OK) json_write_text(&p->json, "picture_missing", status_message());
}

/* ---- the page ---------------------------------------------------------------------------------------------------- */

/* Writes the output frames of the run in `folder` to the page p, which shows them as a film; writes nothing if there
 * are none. scene: scene of the run; NULL: not known. Stores the number of particles of the first frame in *particles,
 * 0 without frames. Returns FAILED, with a message, if a frame cannot be read. */
static status write_film(struct html_page *p, const char *folder, const struct scene *scene, int64_t *particles)
{
    struct run_animation f;
    *particles = 0;
    if (!run_folder_has_file(folder, "frames.hdf.series")) return OK;
    TRY(animation_read_frames_of_run(&f, folder, scene));
    *particles = f.set[0].n;
    animation_select_content_within_byte_budget(&f, FILM_BYTES);
    const status s = animation_write_to_page(p, &f);
    animation_free(&f);
    return s;
}

status report_add_run_entries_to_page(struct html_page *p, const struct report_request *request, const char *page_path)
{
    char header[HEADER_ROOM];
    int64_t particles;
    struct scene scene;
    json_write_text(&p->json, "kind", "run");
    html_page_add_text_file(p, "scene", request->folder, "scene.yaml");
    const bool known = scene_read(&scene, path_join(request->folder, "scene.yaml").text, NULL, 0) == OK;
    if (!known) json_write_text(&p->json, "picture_missing", status_message());
    history_read_header(header, sizeof header, request->folder);
    write_figures(p, request->folder, header);
    status s = write_film(p, request->folder, known ? &scene : NULL, &particles);
    if (s == OK) s = write_history(p, request->folder, header);
    if (s == OK && known) write_scene(p, request->folder, &scene, particles, page_path);
    if (known) scene_free(&scene);
    return s;
}
