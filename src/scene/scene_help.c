/* Reference of the scene keys, from the table of keys: `cleave help` and the manual page. */
#include "scene_internal.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

/* ---- facts of a key ---------------------------------------------------------------------------------------------- */

static const char *type_text(const struct key *k)
{
    switch (k->type) {
    case KEY_REAL: return k->words ? "number or auto" : "number";
    case KEY_INT:
    case KEY_SEED: return "whole number";
    case KEY_FLAG: return "true or false";
    case KEY_CHOICE: return "word";
    case KEY_SET: return "list of words";
    case KEY_SERIES: return "list of numbers";
    case KEY_NAME: return "name";
    case KEY_POINT: return "list of numbers";
    case KEY_MATRIX: return "matrix";
    case KEY_REGION: return "solids";
    case KEY_BODY: return "name of a body";
    case KEY_MATERIAL: return "name of a material";
    case KEY_MAP:
    case KEY_PART: return "keys";
    case KEY_LIST: return "list";
    case KEY_GROUP: return "keys of solids";
    default: return k->words;
    }
}

/* Range or words of a key in words; "" where it has none. */
static void range_text(const struct key *k, char *text, size_t room)
{
    char least[32], most[32];
    *text = '\0';
    if ((k->type == KEY_CHOICE || k->type == KEY_SET) && k->words) {
        size_t used = 0;
        for (const char *c = k->words; *c && used + 3 < room; c++) {
            text[used++] = *c == '|' ? ',' : *c;
            if (*c == '|') text[used++] = ' ';
        }
        text[used] = '\0';
        return;
    }
    if (!k->range.given) return;
    number_text(least, k->range.least);
    number_text(most, k->range.most);
    if (isinf(k->range.most)) snprintf(text, room, "%s %s", k->range.open ? ">" : ">=", least);
    else if (k->range.open) snprintf(text, room, "> %s, <= %s", least, most);
    else snprintf(text, room, "%s .. %s", least, most);
    if (k->type == KEY_LIST || k->type == KEY_HAND) {
        size_t used = strlen(text);
        if (k->type == KEY_LIST || k->range.least > 1) snprintf(text + used, room - used, " items");
    }
}

/* The default without the brackets that mark a default set by code. */
static void default_text(const struct key *k, char *text, size_t room)
{
    bool explained = *k->fallback == '(';
    size_t length = strlen(k->fallback) - (explained ? 2 : 0);
    snprintf(text, room, "%.*s", (int)length, k->fallback + explained);
    if (strcmp(text, "-") == 0) *text = '\0';
}

/* All facts about a key but its path, in one line. */
static void facts_text(const struct key *k, char *text, size_t room)
{
    char range[128], fallback[96];
    range_text(k, range, sizeof range);
    default_text(k, fallback, sizeof fallback);
    const char *symbol = unit_rows[k->unit].symbol;
    bool required = strncmp(fallback, "required", 8) == 0;
    snprintf(text, room, "%s%s%s%s%s%s%s%s%s", type_text(k), *symbol ? " [" : "", symbol, *symbol ? "]" : "",
             *range ? "; " : "", range, *fallback ? "; " : "", *fallback && !required ? "default " : "", fallback);
}

/* ---- cleave help ------------------------------------------------------------------------------------------------- */

/* Path in the table of keys of a key as typed by a user: indices are dropped, `materials` becomes `material`. */
static void path_of_table(const char *key, char *path, size_t room)
{
    size_t used = 0, skip = 0;
    if (strncmp(key, "materials.", 10) == 0 || strncmp(key, "materials[", 10) == 0) {
        used = (size_t)snprintf(path, room, "material");
        skip = 9;
    }
    for (const char *c = key + skip; *c && used + 1 < room; c++) {
        if (*c == '[') c += strcspn(c, "]");
        else path[used++] = *c;
        if (*c == '\0') break;
    }
    path[used] = '\0';
    text_harmless(path);
}

/* True if k is the key `path` or below it; "" holds all keys. */
static bool is_below(const struct key *k, const char *path)
{
    size_t length = strlen(path);
    if (strncmp(k->path, path, length) != 0) return false;
    return length == 0 || k->path[length] == '\0' || k->path[length] == '.';
}

/* REFUSED with the key nearest to `path` by edit distance. */
static status help_unknown(const char *path)
{
    const struct key *nearest = &keys[0];
    for (int k = 1; k < keys_count; k++) {
        int here = edit_distance(keys[k].path, path), leaf = edit_distance(key_leaf(&keys[k]), path);
        int best = edit_distance(nearest->path, path), best_leaf = edit_distance(key_leaf(nearest), path);
        if ((here < leaf ? here : leaf) < (best < best_leaf ? best : best_leaf)) nearest = &keys[k];
    }
    return status_set(REFUSED, "%.64s: unknown key; the nearest is %s", path, nearest->path);
}

status scene_help(FILE *out, const char *key)
{
    char path[128] = "", facts[384];
    int found = 0;
    if (key) path_of_table(key, path, sizeof path);
    const char *now = path_now(path);
    if (now) fprintf(out, "%s is now called %s\n\n", path, now), snprintf(path, sizeof path, "%s", now);
    for (int k = 0; k < keys_count; k++) found += is_below(&keys[k], path);
    if (found == 0) return help_unknown(path);
    if (!key) fprintf(out, "Keys of a scene: type [SI unit]; range or words; default. A number without a unit is SI.\n"
                           "Units are written behind it: 0.5 mm, 190 GPa, 7800 kg/m^3.\n\n");
    for (int k = 0; k < keys_count; k++) {
        if (!is_below(&keys[k], path)) continue;
        bool top = !strchr(keys[k].path, '.'), has_keys = keys[k].type >= KEY_MAP;
        if (top && has_keys && !key) fputc('\n', out);
        facts_text(&keys[k], facts, sizeof facts);
        fprintf(out, "%-30s %s\n%-30s   %s\n", keys[k].path, facts, "", keys[k].help);
    }
    return OK;
}

/* ---- cleave.1 ---------------------------------------------------------------------------------------------------- */

static const char manual_head[] =
    ".TH CLEAVE 1 \"\" \"cleave " CLEAVE_VERSION "\" \"User commands\"\n"
    ".SH NAME\ncleave \\- dynamic fracture by peridynamics, material points and the conversion between them\n"
    ".SH SYNOPSIS\n"
    ".B cleave run\n.I scene\n[\\fB\\-o\\fR \\fIdir\\fR] [\\fB\\-s\\fR \\fIkey\\fR=\\fIvalue\\fR]... "
    "[\\fB\\-t\\fR \\fIthreads\\fR] [\\fB\\-\\-resume\\fR|\\fB\\-\\-overwrite\\fR] [\\fB\\-q\\fR]\n.br\n"
    ".B cleave check\n.I scene\n[\\fB\\-s\\fR \\fIkey\\fR=\\fIvalue\\fR]...\n.br\n"
    ".B cleave plot\n.I dir\n.br\n"
    ".B cleave compare\n.I dir dir\n.br\n"
    ".B cleave bench\n[\\fIname\\fR]... [\\fB\\-\\-quick\\fR]\n.br\n"
    ".B cleave help\n[\\fIkey\\fR|\\fBtrust\\fR]\n.br\n"
    ".B cleave info\n"
    ".SH DESCRIPTION\n"
    "A scene is a YAML file that says what breaks. The body is peridynamic where its material breaks and made of\n"
    "material points elsewhere; the points become peridynamic particles while the run goes on.\n"
    ".TP\n.B run\nruns a scene and leaves its results in a folder (default results/ and the scene's name).\n"
    ".TP\n.B check\nreads a scene and tells its size, cost and soundness without running a step.\n"
    ".TP\n.B plot\ndraws pictures of a run, finished or not.\n"
    ".TP\n.B compare\ntells how far two runs are apart.\n"
    ".TP\n.B bench\nmeasures the program.\n"
    ".TP\n.B help\nprints the keys below, those that begin with a key, or one; with trust, what a run promises.\n"
    ".TP\n.B info\nprints version, build, sets of kernels, threads, cores and caches.\n"
    ".SH OPTIONS\n"
    ".TP\n.B \\-o \\fIdir\\fR\nfolder of the results. One that holds another run is refused.\n"
    ".TP\n.B \\-s \\fIkey\\fR=\\fIvalue\\fR\nlays a value over the scene's: material.young=70e9, "
    "boundary.0.velocity='[0, 20 m/s]', cracks.1.to='[20 mm, 0]', materials.steel.young=210e9. Items of lists go by "
    "number,\n"
    "from 0 (boundary.0 or boundary[0]), or by name. An empty value takes the key, or the item, away.\n"
    ".TP\n.B \\-t \\fIthreads\\fR\nnumber of threads. The results do not depend on it.\n"
    ".TP\n.B \\-\\-resume\ngoes on from the newest checkpoint.\n"
    ".TP\n.B \\-\\-overwrite\nreplaces an older run, which is left alone otherwise.\n"
    ".TP\n.B \\-q\nno progress and no figures at the end; warnings are still said, and stand in summary.json.\n"
    ".SH EXIT STATUS\n"
    ".TP\n.B 0\ndone\n.TP\n.B 1\nthe run failed\n.TP\n.B 2\nthe scene or the command line is wrong\n"
    ".TP\n.B 130\ninterrupted, after a checkpoint\n"
    ".SH ENVIRONMENT\nNO_COLOR, OMP_NUM_THREADS, OMP_PLACES and OMP_PROC_BIND are honoured.\n"
    "CLEAVE_SIMD takes a set of kernels other than the widest that the processor runs: avx512, avx2 or portable.\n"
    ".SH SIGNALS\nSIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1 and SIGUSR2 end a run with a checkpoint; the first three "
    "end it at once the\n"
    "second time. One that was ignored when the program was started stays ignored.\n"
    ".SH FILES\n"
    ".TP\n.I frames/NNNNNN.hdf, frames.hdf.series\nthe frames (VTKHDF) and the index that ParaView opens\n"
    ".TP\n.I frames.xdmf\nthe same for other readers\n"
    ".TP\n.I history.csv\none line per sample: energies, momentum, crack tip, probes; pd_share and mpm_share, shares "
    "of the\n"
    "particles by method, and rest_share, the share of them that rested, mean over the steps since the last sample\n"
    ".TP\n.I NAME_NNNNNN.csv\nprofiles of the line and exact probe NAME, one with every frame\n"
    ".TP\n.I summary.json\nthe figures of the run\n"
    ".TP\n.I scene.yaml\nthe scene as run, every default written out\n"
    ".TP\n.I checkpoint.h5, checkpoint.previous.h5\nthe two newest checkpoints\n"
    ".SH SCENE\n"
    "Numbers are SI or carry a unit (190 GPa, 0.5 mm, 20 us, 7800 kg/m^3, 2 %) and may be fractions (1/3). The key\n"
    "decides what a value is: yes, 010 or 1:30 mean nothing special, and flags are true or false. Points are lists\n"
    "of as many components as the space has. One document, no anchors, aliases or tags. In messages and below,\n"
    "keys are written with dots; items of lists have the keys below the list.\n";

/* Writes text with the characters escaped that have a meaning in troff. */
static void troff(FILE *out, const char *text)
{
    for (const char *c = text; *c; c++) {
        if (*c == '\\') fputs("\\e", out);
        else if (*c == '-') fputs("\\-", out);
        else if (*c == '^') fputs("\\(ha", out);
        else fputc(*c, out);
    }
}

status scene_manual(FILE *out)
{
    char facts[384];
    fputs(manual_head, out);
    for (int k = 0; k < keys_count; k++) {
        facts_text(&keys[k], facts, sizeof facts);
        fputs(".TP\n.B ", out);
        troff(out, keys[k].path);
        fputs("\n", out);
        troff(out, facts);
        fputs("\n.br\n", out);
        troff(out, keys[k].help);
        fputs("\n", out);
    }
    return ferror(out) ? status_set(FAILED, "the manual page cannot be written") : OK;
}
