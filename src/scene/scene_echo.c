/* Writes the scene as run in YAML that reads back to an identical scene, bit by bit: SI units, with all defaults. */
#include "scene_echo.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"

void yaml_write_key(struct yaml_writer *w, const char *key)
{
    fprintf(w->out, "%*s%s%s:", w->indent - (w->dash ? 2 : 0), "", w->dash ? "- " : "", key);
    w->dash = false;
}

void yaml_write_real(struct yaml_writer *w, real value)
{
    char text[32];
    fputs(number_write_shortest_exact_decimal(text, value), w->out);
}

void yaml_write_number_list(struct yaml_writer *w, const real *value, int count)
{
    for (int k = 0; k < count; k++) {
        fputs(k ? ", " : "[", w->out);
        yaml_write_real(w, value[k]);
    }
    fputc(']', w->out);
}

static void write_matrix(struct yaml_writer *w, const real *value)
{
    int dim = w->scene->dim;
    for (int k = 0; k < dim; k++) {
        fputs(k ? ", " : "[", w->out);
        yaml_write_number_list(w, value + k * dim, dim);
    }
    fputc(']', w->out);
}

/* Decodes the UTF-8 character at c and stores its code point in *code. Returns the number of bytes of the character. An
 * invalid byte counts as one character with the value of the byte. */
static int letter_of(const unsigned char *c, unsigned *code)
{
    int more = *c >= 0xF0 ? 3 : *c >= 0xE0 ? 2 : *c >= 0xC0 ? 1 : 0;
    *code = more ? *c & (0x3F >> more) : *c;
    for (int k = 1; k <= more; k++) {
        if ((c[k] & 0xC0) != 0x80) {
            *code = *c;
            return 1;
        }
        *code = *code << 6 | (c[k] & 0x3F);
    }
    return more + 1;
}

/* Writes `text` in double quotes to scene.yaml (w), as a YAML scalar. Quotes and backslashes are escaped; characters
 * other than printable ASCII become \U escapes. */
void yaml_write_quoted_text(struct yaml_writer *w, const char *text)
{
    fputc('"', w->out);
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        unsigned code;
        c += letter_of(c, &code);
        if (code == '"' || code == '\\')
            fprintf(w->out, "\\%c", (char)code);
        else if (code >= ' ' && code < 0x7F)
            fputc((int)code, w->out);
        else
            fprintf(w->out, "\\U%08X", code);
    }
    fputc('"', w->out);
}

static void write_word(struct yaml_writer *w, const char *words, int index)
{
    while (index-- > 0) words = strchr(words, '|') + 1;
    fprintf(w->out, "%.*s", (int)strcspn(words, "|"), words);
}

static void write_choice(struct yaml_writer *w, const struct key *k, const void *place)
{
    int word = 0;
    if (k->size == sizeof word) memcpy(&word, place, sizeof word);
    if (k->size == 1) word = *(const bool *)place;
    write_word(w, k->words, word);
}

/* Writes the words of key k (of input files) whose bits are set in `bits` to scene.yaml (w) as a YAML list; `none` if
 * no bit is set. */
static void write_set(struct yaml_writer *w, const struct key *k, unsigned bits)
{
    const char *between = "[";
    if (!bits) fputs("none", w->out);
    for (int word = 0; bits >> word; word++) {
        if (!(bits >> word & 1)) continue;
        fputs(between, w->out);
        write_word(w, k->words, word);
        between = ", ";
    }
    if (bits) fputc(']', w->out);
}

void yaml_write_value(struct yaml_writer *w, const struct key *k, const void *value_address)
{
    const struct scene *s = w->scene;
    switch (k->type) {
    case KEY_REAL: {
        real value = *(const real *)value_address;
        bool word = k->words && (value == k->word_value || isnan(value));
        if (word)
            fputs(k->words, w->out);
        else
            yaml_write_real(w, value);
        break;
    }
    case KEY_INT:
        fprintf(w->out, "%d", *(const int *)value_address);
        break;
    case KEY_SEED:
        fprintf(w->out, "%" PRIu64, *(const uint64_t *)value_address);
        break;
    case KEY_FLAG:
        fputs(*(const bool *)value_address ? "true" : "false", w->out);
        break;
    case KEY_CHOICE:
        write_choice(w, k, value_address);
        break;
    case KEY_SET:
        write_set(w, k, *(const unsigned *)value_address);
        break;
    case KEY_SERIES: {
        const struct number_list *list = value_address;
        yaml_write_number_list(w, list->value, list->n);
        break;
    }
    case KEY_NAME:
        yaml_write_quoted_text(w, value_address);
        break;
    case KEY_POINT:
        yaml_write_number_list(w, value_address, w->dim);
        break;
    case KEY_MATRIX:
        write_matrix(w, value_address);
        break;
    case KEY_REGION:
        yaml_write_region(w, value_address);
        break;
    case KEY_BODY:
        yaml_write_quoted_text(w, s->body[*(const int *)value_address].name);
        break;
    case KEY_MATERIAL:
        yaml_write_quoted_text(w, s->material[*(const int *)value_address].name);
        break;
    default:
        break;
    }
}

/* Returns true if scene.yaml contains the key k (of input files): the key has a type that the table of keys can write,
 * and its value, given or by default, is not empty. base: the structure of the key's group; place: address of the
 * value in it. */
static bool has_value(const struct key *k, const void *base, const void *place)
{
    if (k->of_process || k->type >= KEY_MAP || (!k->place && k->type != KEY_CHOICE)) return false;
    if (k->has && !*((const bool *)base + (k->has - 1))) return false;
    if (k->type == KEY_REAL) return k->words || !isnan(*(const real *)place);
    if (k->type == KEY_NAME) return *(const char *)place != '\0';
    if (k->type == KEY_REGION) return ((const struct region *)place)->n > 0;
    if (k->type == KEY_BODY) return *(const int *)place >= 0;
    if (k->type == KEY_SERIES) return ((const struct number_list *)place)->n > 0;
    return true;
}

const void *key_get_value_address_in_group(const struct key *k, const void *group_values)
{
    return k->place ? (const char *)group_values + (k->place - 1) : NULL;
}

/* Returns true if key k (of input files) of the group `bodies` is not written for the body `base` (struct scene_body),
 * since it has no meaning for it. For a rigid body these are the keys material and frame; with a mass (it moves
 * freely) also ramp; without one (it is driven) also mass and force, and ramp if it is 0. For any other body these are
 * the keys rigid, mass, force and ramp. group: path of the key's group; false for other groups than bodies. */
static bool is_left_out(const struct key *k, const char *group, const void *base)
{
    static const char *const words[] = {"material", "frame", "rigid", "mass", "force", "ramp"};
    const struct scene_body *b = base;
    size_t n = 0;
    if (strcmp(group, "bodies") != 0) return false;
    while (n < COUNT_OF(words) && strcmp(key_get_last_name_of_path(k), words[n]) != 0) n++;
    if (!b->rigid) return n >= 2 && n < COUNT_OF(words);
    return n < 2 || (b->mass > 0 ? n == 5 : n == 3 || n == 4 || (n == 5 && !(b->ramp > 0)));
}

/* Writes the list output.regions to scene.yaml (w): the regions for which the run writes additional output frames, at
 * intervals of their own. */
static void write_series(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    if (s->n_series == 0) return;
    yaml_write_key(w, "regions");
    fputc('\n', w->out);
    w->indent += 4;
    for (int k = 0; k < s->n_series; k++) {
        w->dash = true;
        yaml_write_keys_of_group(w, "output.regions", &s->series[k]);
    }
    w->indent -= 4;
}

/* Writes all keys to scene.yaml (w) that are directly below the path `group_path` and have a value in the structure
 * `group_values`, with their units as comments. */
void yaml_write_keys_of_group(struct yaml_writer *w, const char *group_path, const void *group_values)
{
    for (int i = 0; i < keys_count; i++) {
        const struct key *k = &keys[i];
        if (!key_is_directly_below(k, group_path) || is_left_out(k, group_path, group_values)) continue;
        if (k->type == KEY_MAP) {
            yaml_write_key(w, key_get_last_name_of_path(k));
            fputc('\n', w->out);
            w->indent += 2;
            yaml_write_keys_of_group(w, k->path, group_values);
            if (strcmp(k->path, "output") == 0) write_series(w);
            w->indent -= 2;
        }
        if (!has_value(k, group_values, key_get_value_address_in_group(k, group_values))) continue;
        yaml_write_key(w, key_get_last_name_of_path(k));
        fputc(' ', w->out);
        yaml_write_value(w, k, key_get_value_address_in_group(k, group_values));
        fprintf(w->out, "%s%s\n", k->unit ? "  # " : "", unit_rows[k->unit].symbol);
    }
}

/* ---- lists ------------------------------------------------------------------------------------------------------- */

/* Begins an item of a YAML list: sets the indent of w, and makes yaml_write_key write a dash before the item's first
 * key. */
void yaml_begin_list_item(struct yaml_writer *w)
{
    w->indent = 4;
    w->dash = true;
}

/* Writes to scene.yaml (w) the line `key:` and below it, indented, the keys that are directly below the path
 * `group_path` and have a value in the structure `group_values`. */
void yaml_write_group_as_mapping(struct yaml_writer *w, const char *key, const char *group_path,
                                 const void *group_values)
{
    yaml_write_key(w, key);
    fputc('\n', w->out);
    w->indent += 2;
    yaml_write_keys_of_group(w, group_path, group_values);
    w->indent -= 2;
}

/* Writes the key `table` with the pairs x[k], y[k], k = 0 .. points - 1, to scene.yaml (w). units: units of x and y,
 * written as a comment. */
static void write_pairs(struct yaml_writer *w, const real *x, const real *y, int points, const char *units)
{
    yaml_write_key(w, "table");
    for (int k = 0; k < points; k++) {
        fputs(k ? ", " : " [", w->out);
        yaml_write_number_list(w, (const real[]){x[k], y[k]}, 2);
    }
    fprintf(w->out, "]  # %s\n", units);
}

/* Writes the flow law and the kinematic hardening of the material m to scene.yaml (w), if m yields. Linear hardening
 * that the key yield_tangent gives is not written here. */
static void write_material_law(struct yaml_writer *w, const struct material *m)
{
    const struct law *law = &m->law;
    const char *word = flow_properties[law->flow].word;
    char group[64];
    if (!law->given) return;
    snprintf(group, sizeof group, "material.hardening.%s", word ? word : "");
    if (!word)
        yaml_write_group_as_mapping(w, "johnson_cook", "material.johnson_cook", law);
    else if (law->flow != FLOW_LINEAR || law->hardening != m->yield_hardening) {
        yaml_write_key(w, "hardening");
        fputc('\n', w->out);
        w->indent += 2;
        if (law->flow == FLOW_TABLE)
            write_pairs(w, law->table.strain, law->table.stress, law->table.points, "1, Pa");
        else
            yaml_write_group_as_mapping(w, word, group, law);
        w->indent -= 2;
    }
    if (law->kinematic.modulus > 0) yaml_write_group_as_mapping(w, "kinematic", "material.kinematic", law);
}

/* Writes the key `rate` of a material to scene.yaml (w), the table by which its tensile strength grows with the strain
 * rate. Writes nothing if the strength does not depend on the rate. */
static void write_rate(struct yaml_writer *w, const struct strength_rate *rate)
{
    if (rate->points == 0) return;
    yaml_write_key(w, "rate");
    fputc('\n', w->out);
    w->indent += 2;
    write_pairs(w, rate->rate, rate->factor, rate->points, "1/s, 1");
    w->indent -= 2;
}

/* Writes the materials of the scene to scene.yaml (w): the key `material` for a single one, else the list `materials`.
 */
static void write_materials(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    const int n = s->materials + s->unused_materials;
    bool one = n == 1; /* overrides of material.young then apply to the echo */
    fprintf(w->out, one ? "material:\n" : "materials:\n");
    for (int k = 0; k < n; k++) {
        struct material m = *scene_find_material_by_number(s, k);
        if (!isnan(m.energy_release_rate)) m.critical_stretch = NAN; /* follows from energy_release_rate */
        yaml_begin_list_item(w);
        if (one) w->indent = 2, w->dash = false;
        yaml_write_keys_of_group(w, "material", &m);
        write_material_law(w, &m);
        write_rate(w, &m.rate);
        if (material_has_viscosity(&m)) yaml_write_group_as_mapping(w, "viscosity", "material.viscosity", &m);
        if (m.scatter.given) yaml_write_group_as_mapping(w, "scatter", "material.scatter", &m.scatter);
    }
}

/* Writes to w the line `key: "file"` with the absolute path of the file, so that scene.yaml can be run from any folder.
 * contents_hash: hash of the file, written as a comment, since a run resumes only with identical contents; 0: the file
 * has not been read, and its name is written as it is. */
void yaml_write_file_path_and_hash(struct yaml_writer *w, const char *key, const char *file, uint64_t contents_hash)
{
    char *whole = contents_hash ? realpath(file, NULL) : NULL;
    yaml_write_key(w, key);
    fputc(' ', w->out);
    yaml_write_quoted_text(w, whole ? whole : file);
    if (contents_hash) fprintf(w->out, "  # contents %016" PRIx64, contents_hash);
    fputc('\n', w->out);
    free(whole);
}

/* Writes the key `particles` of the body b to scene.yaml (w): the file of its particle list, with scale and columns if
 * the input file (scene) gives them. */
static void write_particle_list(struct yaml_writer *w, const struct scene_body *b)
{
    const bool formed = b->form.scale > 0 || b->form.columns;
    if (!formed) {
        yaml_write_file_path_and_hash(w, "particles", b->file, b->contents);
        return;
    }
    yaml_write_key(w, "particles");
    fputc('\n', w->out);
    w->indent += 2;
    yaml_write_file_path_and_hash(w, "file", b->file, b->contents);
    if (b->form.scale > 0) {
        yaml_write_key(w, "scale");
        fputc(' ', w->out);
        yaml_write_real(w, b->form.scale);
        fputs("  # m\n", w->out);
    }
    if (b->form.columns) {
        yaml_write_key(w, "columns");
        fprintf(w->out, " [\"");
        for (const char *c = b->form.columns; *c; c++) *c == ',' ? fputs("\", \"", w->out) : fputc(*c, w->out);
        fprintf(w->out, "\"]\n");
    }
    w->indent -= 2;
}

static void write_body_parts(struct yaml_writer *w, const struct scene_body *b)
{
    if (!b->parts) return;
    yaml_write_key(w, "parts");
    fputc('\n', w->out);
    for (int k = 0; k < b->parts; k++) {
        w->indent = 8, w->dash = true;
        yaml_write_keys_of_group(w, "bodies.parts", &b->part[k]);
    }
}

static void write_bodies(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    fputs("bodies:\n", w->out);
    for (int k = 0; k < s->bodies + s->rigids; k++) {
        yaml_begin_list_item(w);
        yaml_write_keys_of_group(w, "bodies", &s->body[k]);
        if (s->body[k].file) write_particle_list(w, &s->body[k]);
        write_body_parts(w, &s->body[k]);
    }
}

static void write_interfaces(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    if (s->interfaces) fputs("interfaces:\n", w->out);
    for (int k = 0; k < s->interfaces; k++) {
        struct scene_interface face = s->interface[k];
        if (!(face.energy_release_rate > 0)) face.energy_release_rate = NAN; /* not given */
        yaml_begin_list_item(w);
        yaml_write_key(w, "bodies");
        fputs(" [", w->out);
        yaml_write_quoted_text(w, s->body[face.body[0]].name);
        fputs(", ", w->out);
        yaml_write_quoted_text(w, s->body[face.body[1]].name);
        fputs("]\n", w->out);
        yaml_write_keys_of_group(w, "interfaces", &face);
    }
}

static void write_cracks(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    if (s->cracks_given) fputs("cracks:\n", w->out);
    for (int k = 0; k < s->cracks_given; k++) {
        const struct crack *c = &s->crack[k];
        fprintf(w->out, "  - {%s: ", s->dim == 1 ? "at" : s->dim == 2 ? "from" : "polygon");
        for (int j = 0; j < c->n; j++) {
            fputs(j == 0 ? s->dim == 3 ? "[" : "" : s->dim == 2 ? ", to: " : ", ", w->out);
            yaml_write_number_list(w, c->corner[j], s->dim);
        }
        fputs(s->dim == 3 ? "]" : "", w->out);
        if (c->width > 0) fprintf(w->out, ", width: %.17g", c->width);
        fputs("}\n", w->out);
    }
}

static void write_growths(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    if (s->growths) fputs("growth:\n", w->out);
    for (int k = 0; k < s->growths; k++) {
        struct growth_rule g = s->growth[k];
        if (!g.probe[0]) g.toughness = NAN; /* without a meaning if there is no probe */
        yaml_begin_list_item(w);
        yaml_write_keys_of_group(w, "growth", &g);
    }
}

static void write_initials(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    if (s->initials) fputs("initial:\n", w->out);
    for (int k = 0; k < s->initials; k++) {
        yaml_begin_list_item(w);
        const struct scene_initial *one = &s->initial[k];
        yaml_write_keys_of_group(w, "initial", one);
        if (one->sets_velocity) yaml_write_vector_of_formulas(w, "velocity", one->velocity, one->formula);
        if (one->sets_pulse) yaml_write_group_as_mapping(w, "pulse", "initial.pulse", one);
    }
}

static void write_probes(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    if (s->probes) fputs("probes:\n", w->out);
    for (int k = 0; k < s->probes; k++) {
        char group[32];
        snprintf(group, sizeof group, "probes.%s", probe_names[s->probe[k].kind]);
        fprintf(w->out, "  - %s:\n", probe_names[s->probe[k].kind]);
        w->indent = 6;
        yaml_write_keys_of_group(w, group, &s->probe[k]);
    }
}

char *scene_to_yaml(const struct scene *s)
{
    char *text = NULL, *kept;
    size_t length = 0;
    struct scene head = *s; /* a copy without the measures that the space does not have */
    if (s->dim != 2) head.thickness = NAN;
    if (s->dim != 1) head.section = NAN;
    head.has_frames = s->times.n == 0 && s->every == 0;
    struct yaml_writer w = {.out = memory_stream_open(&text, &length), .scene = s, .dim = s->dim};
    if (!w.out) return NULL;
    yaml_write_keys_of_group(&w, "", &head);
    write_materials(&w);
    yaml_write_named_regions(&w);
    write_bodies(&w);
    write_interfaces(&w);
    write_cracks(&w);
    write_initials(&w);
    yaml_write_boundaries(&w);
    write_probes(&w);
    write_growths(&w);
    if (fclose(w.out) != 0) {
        free(text);
        return NULL;
    }
    kept = NEW("scene text", length + 1, char);
    memcpy(kept, text, length + 1);
    free(text);
    return kept;
}
