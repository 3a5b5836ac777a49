/* Prints the usage, the manual page cleave.1, and its part about runs as `cleave help run`. Commands come from their
 * table, keys from the table of keys. */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "scene/scene.h"

/* ---- texts ------------------------------------------------------------------------------------------------------- */

/* An entry of the manual. term: option or word that the entry explains; NULL: the entry is a paragraph. text: the
 * explanation. of: names of the commands to which the entry applies; NULL: all commands that have the option. */
struct entry {
    const char *term, *text, *of;
};
/* A section of the manual with n entries. of_run: the section belongs to the page of `cleave run` as well. */
struct section {
    const char *title;
    const struct entry *entry;
    int n;
    bool of_run;
};

static const struct entry description[] = {
    {NULL,
     "A scene is a YAML file that says what breaks. The body is peridynamic where its material breaks and made of "
     "material points elsewhere; the points become peridynamic particles while the run goes on.",
     NULL},
};
static const struct entry options[] = {
    {"-o DIR",
     "writes the results to this folder (default: results/NAME, where NAME is the name of the scene). A folder that "
     "contains another run is refused.",
     "run"},
    {"-o DIR",
     "writes the results to this folder (default: results/NAME_sweep or results/NAME_converge). A folder that contains "
     "another study is refused.",
     "sweep converge"},
    {"-o DIR", "writes the input of LAMMPS to this folder; exodus: to a file whose name ends in .exo, .e or .g.",
     "export"},
    {"-o FILE",
     "writes the picture to this file or folder (default: pictures/ of the run; with --scene, results/NAME_scene.png).",
     "plot"},
    {"-o PAGE.html", "writes the page to this file or folder (default: report.html in DIR).", "report"},
    {"-s KEY=VALUE",
     "replaces the value of a key of the scene, or adds the key: material.young=70e9, boundary.0.velocity='[0, 20 "
     "m/s]', cracks.1.to='[20 mm, 0]', materials.steel.young=210e9. Items of lists are named by their number, from 0 "
     "(boundary.0 or boundary[0]), or by their name. An empty value, KEY=, removes the key or the item.",
     NULL},
    {"-t THREADS", "sets the number of threads. The results do not depend on it.", NULL},
    {"--resume", "continues the run in the folder from its newest checkpoint.", NULL},
    {"--overwrite", "replaces an older run in the folder. Without this option the command is refused.", "run"},
    {"--overwrite", "replaces an older study or export in the folder. Without this option the command is refused.",
     "sweep converge export"},
    {"--overwrite", "replaces a file that cleave has not drawn. Without this option the command is refused.", "plot"},
    {"--overwrite", "replaces a file that is not a page of cleave. Without this option the command is refused.",
     "report"},
    {"--report", "writes report.html, the page of cleave report, into the folder at the end of the run.", NULL},
    {"-q", "prints no progress and no figures at the end. Warnings are printed, and are in summary.json.",
     "run sweep converge"},
    {"-q", "does not print the name of the page.", "report"},
    {"-j RUNS", "sets how many runs of a study run at the same time (default: the number of cores).", NULL},
    {"--list", "prints the command of each run, one per line, and runs nothing.", NULL},
    {"--collect", "makes the table and the pictures of a study from its finished runs, and runs nothing.", NULL},
    {"--of FIGURE",
     "studies this figure of summary.json, its names joined by points, such as crack.start_time. The option may be "
     "repeated.",
     NULL},
    {"--budget TIME", "limits the time for the runs of a study, such as 5min.", NULL},
    {"--levels COUNT", "sets the number of spacings, from 3 to 6.", NULL},
    {"--runs COUNT", "sets the number of runs at each spacing.", NULL},
    {"--horizon", "keeps the length of the horizon while the spacing varies.", NULL},
    {"--field NAME", "draws this field of the frames: displacement, velocity_y, von_mises, ...", NULL},
    {"--times T,...", "draws the frames nearest to these times, as 10us,20us,last; or all.", NULL},
    {"--frames N", "draws so many frames, evenly spread in time; or all, or last.", NULL},
    {"--slice z=4mm", "draws a section through a solid. Without a position the section goes through the most damage.",
     NULL},
    {"--view iso", "draws a solid from outside: iso, x+, x-, y+, y-, z+, z-.", NULL},
    {"--range LOW:HIGH",
     "sets the ends of the colours, such as 0:50MPa (default: by the values of the frame; the bar says what is "
     "beyond).",
     NULL},
    {"--colours NAME", "sets the colours of fields and damage: viridis, cividis, inferno, magma, grey or diverging.",
     NULL},
    {"--magnify N", "draws displacements N times as large.", NULL},
    {"--crop X:X,Y:Y", "draws only this rectangle, such as 0:20mm,-5:5mm.", NULL},
    {"--title TEXT", "writes this above the picture.", NULL},
    {"--size WxH",
     "sets the size of the picture: in pixels, such as 1600x900, or as printed, such as 90mmx60mm; or its width alone, "
     "such as 85mm.",
     NULL},
    {"--dpi N", "sets the pixels per inch of a size in millimetres.", NULL},
    {"--fps N", "sets how many frames of a film are shown in a second.", NULL},
    {"--format png",
     "sets the format: png, svg, pdf; plot also has mp4 and gif (films of all frames, made by ffmpeg), and there the "
     "ending of the file of -o sets it, too.",
     NULL},
    {"--scene SCENE", "draws a scene before it runs: particles, cracks, loads, supports, probes.", NULL},
    {"--no-trial", "leaves out the trial steps from which run time and memory are estimated.", NULL},
    {"--style peri",
     "sets the style of LAMMPS: peri is pair_style peri of every version, bpm is bond_style bpm/peri of 2026.", NULL},
    {"--allow-different",
     "exports scenes that LAMMPS computes differently, too. README.txt in the folder lists the differences.", NULL},
    {"--quick", "measures smaller cases.", NULL},
    {"--readme", "writes the output and tables to bench/results/ of the source tree.", NULL},
    {"--help", "after any command: prints its usage and options.", NULL},
    {"--version", "in place of a command: prints the version, and the commit where the source tree was in git.", NULL},
};
static const struct entry exit_status[] = {
    {"0", "done", NULL},
    {"1", "the run failed", NULL},
    {"2", "the scene or the command line is wrong", NULL},
    {"130", "interrupted, after a checkpoint", NULL},
};
static const struct entry environment[] = {
    {"NO_COLOR, OMP_NUM_THREADS, OMP_PLACES, OMP_PROC_BIND", "are honoured.", NULL},
    {"CLEAVE_SIMD",
     "selects a set of kernels in place of the widest that the processor can run: avx512, avx2 or portable.", NULL},
};
static const struct entry signals[] = {
    {NULL,
     "SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1 and SIGUSR2 end a run with a checkpoint; the first three end it at "
     "once the second time. One that was ignored when the program was started stays ignored.",
     NULL},
};
static const struct entry files[] = {
    {"frames/NNNNNN.hdf, frames.hdf.series", "the frames (VTKHDF) and the index that ParaView opens", NULL},
    {"frames/particles_NNNNNN.h5", "what frames share; a frame that is copied without it cannot be opened", NULL},
    {"frames.xdmf", "the same for other readers", NULL},
    {"history.csv",
     "one line per sample: energies, momentum, crack tip, probes, forces of supports; pd_share and mpm_share, shares "
     "of the particles by method, and inactive_share, the share of them that rested, mean over the steps since the "
     "last sample; where nothing outside the bodies acts on them angular_momentum_z (in space _x and _y, too), about "
     "their centre of mass",
     NULL},
    {"NAME_NNNNNN.csv", "profiles of the line and exact probe NAME, one with every frame", NULL},
    {"fragments.csv", "pieces that bonds hold together at the end (method pd)", NULL},
    {"summary.json", "the figures of the run", NULL},
    {"scene.yaml", "the scene as run, every default written out", NULL},
    {"checkpoint.h5, checkpoint.previous.h5", "the two newest checkpoints", NULL},
    {"pictures/", "pictures of cleave plot", NULL},
    {"report.html", "the page of cleave report", NULL},
};
static const struct entry scene_form[] = {
    {NULL,
     "Numbers are SI or carry a unit (190 GPa, 0.5 mm, 20 us, 7800 kg/m^3, 2 %) and may be fractions (1/3). The key "
     "decides what a value is: yes, 010 or 1:30 mean nothing special, and flags are true or false. Points are lists "
     "of as many components as the space has. One document, no anchors, aliases or tags. In messages and below, keys "
     "are written with dots; items of lists have the keys below the list.",
     NULL},
};
static const struct entry documents[] = {
    {NULL,
     "Manual and scenes lie in share/doc/cleave beside the folder bin of the program: README.md, inputs/README.md.",
     NULL},
};
static const struct entry copyright[] = {
    {NULL, "Copyright (c) 2026, the Cleave developers. Licence: BSD-3-Clause; its text is in share/doc/cleave/LICENSE.",
     NULL},
};
#define SECTION(title, entries, of_run)                                                                                \
    {                                                                                                                  \
        title, entries, COUNT_OF(entries), of_run                                                                      \
    }
static const struct section sections[] = {
    SECTION("DESCRIPTION", description, false), SECTION("OPTIONS", options, true),
    SECTION("EXIT STATUS", exit_status, true),  SECTION("ENVIRONMENT", environment, true),
    SECTION("SIGNALS", signals, true),          SECTION("FILES", files, true),
    SECTION("SCENE", scene_form, false),        SECTION("SEE ALSO", documents, false),
    SECTION("COPYRIGHT", copyright, false),
};

/* Prints `text` to `out`, broken at blanks into lines of at most 100 characters that begin with `indent` blanks. */
static void wrapped(FILE *out, const char *text, int indent)
{
    int column = 0;
    while (*text) {
        int length = (int)strcspn(text, " ");
        if (column == 0 || column + 1 + length > 100)
            column = fprintf(out, "%s%*s", column ? "\n" : "", indent, "") - (column != 0);
        else
            column += fprintf(out, " ");
        column += fprintf(out, "%.*s", length, text);
        text += length + (text[length] == ' ');
    }
    fputc('\n', out);
}

/* ---- usage ------------------------------------------------------------------------------------------------------- */

/* Prints the text of `cleave --help` to `out`. */
void usage_print(FILE *out)
{
    fprintf(out, "cleave: dynamic fracture by peridynamics and the material point method\n\n");
    for (int k = 0; k < commands_count; k++) fprintf(out, "  cleave %-9s %s\n", commands[k].name, commands[k].meaning);
    fprintf(
        out,
        "\n`cleave COMMAND --help` says what a command takes; `cleave help run` what a run leaves and how it ends.\n");
}

/* Returns true if the command c has the option `term`, i.e. if the usage of the command contains the option. term: the
 * option, which may be followed by a blank and its value. */
static bool takes_option(const struct command *c, const char *term)
{
    size_t length = strcspn(term, " ");
    for (const char *at = strstr(c->words, term[1] == '-' ? "--" : "-"); at; at = strchr(at + 1, '-'))
        if (!strncmp(at, term, length) && strchr(" ]|", at[length]) && strchr("[| ", at[-1])) return true;
    return false;
}

/* Returns true if the entry e of the manual applies to the command c: its list of command names contains c or is NULL.
 */
static bool is_of(const struct entry *e, const struct command *c)
{
    const size_t length = strlen(c->name);
    bool of = !e->of;
    for (const char *at = e->of; at && *at && !of; at += strcspn(at, " "), at += *at == ' ')
        of = strcspn(at, " ") == length && !strncmp(at, c->name, length);
    return of;
}

void usage_print_of_command(FILE *out, const struct command *c)
{
    fprintf(out, "cleave %s%s%s\n  %s\n", c->name, *c->words ? " " : "", c->words, c->meaning);
    for (size_t k = 0; k < COUNT_OF(options); k++) {
        if (!takes_option(c, options[k].term) || !is_of(&options[k], c)) continue;
        fprintf(out, "  %s\n", options[k].term);
        wrapped(out, options[k].text, 6);
    }
}

/* ---- pages ------------------------------------------------------------------------------------------------------- */

/* Writes `text` and a line break to `out`, with escapes for characters that have a meaning in troff. */
static void troff_text(FILE *out, const char *text)
{
    for (const char *c = text; *c; c++) {
        if (*c == '\\')
            fputs("\\e", out);
        else if (*c == '-')
            fputs("\\-", out);
        else if (*c == '^')
            fputs("\\(ha", out);
        else
            fputc(*c, out);
    }
    fputc('\n', out);
}

static void section_troff(FILE *out, const struct section *s)
{
    fprintf(out, ".SH %s\n", s->title);
    for (int k = 0; k < s->n; k++) {
        if (s->entry[k].term) fputs(".TP\n.B ", out), troff_text(out, s->entry[k].term);
        troff_text(out, s->entry[k].text);
    }
}

/* Returns true if the entry e of the section s belongs to the page `cleave help run`: it is not an option at all, or is
 * an option of `cleave run`. */
static bool is_of_run(const struct section *s, const struct entry *e)
{
    const struct command *run = NULL;
    if (s->entry != options) return true;
    return command_find_by_name("run", &run) == OK && takes_option(run, e->term) && is_of(e, run);
}

status help_print_run_options_files_and_exit_codes(FILE *out)
{
    for (size_t j = 0; j < COUNT_OF(sections); j++) {
        const struct section *s = &sections[j];
        if (!s->of_run) continue;
        fprintf(out, "%s\n", s->title);
        for (int k = 0; k < s->n; k++) {
            if (!is_of_run(s, &s->entry[k])) continue;
            if (s->entry[k].term) fprintf(out, "  %s\n", s->entry[k].term);
            wrapped(out, s->entry[k].text, s->entry[k].term ? 6 : 2);
        }
        fputc('\n', out);
    }
    fprintf(out, "Files are never left half-written: `cleave help trust`. Bodies, loads, results, studies: "
                 "inputs/README.md.\n");
    return OK;
}

status manual_print(FILE *out)
{
    fputs(".TH CLEAVE 1 \"\" \"cleave " CLEAVE_VERSION "\" \"User commands\"\n"
          ".SH NAME\ncleave \\- dynamic fracture by peridynamics, material points and the conversion between them\n"
          ".SH SYNOPSIS\n",
          out);
    for (int k = 0; k < commands_count; k++) {
        fprintf(out, "%s.B cleave %s\n", k ? ".br\n" : "", commands[k].name);
        if (*commands[k].words) troff_text(out, commands[k].words);
    }
    section_troff(out, &sections[0]);
    fputs(".SH COMMANDS\n", out);
    for (int k = 0; k < commands_count; k++) {
        fprintf(out, ".TP\n.B %s\n", commands[k].name);
        troff_text(out, commands[k].meaning);
    }
    for (size_t k = 1; k < COUNT_OF(sections); k++) section_troff(out, &sections[k]);
    scene_print_keys_for_manual_page(out);
    return ferror(out) ? status_set(FAILED, "the manual page cannot be written") : OK;
}
