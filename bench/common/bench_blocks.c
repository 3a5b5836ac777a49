/* Blocks of any size for timing: squares and cubes in which every particle moves and no bond breaks. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench.h"
#include "step/report.h"
#include "scene/scene_read.h"

const struct bench_block bench_blocks[BENCH_BLOCKS] = {
    {"pd", 2, "pd", "current"},
    {"mpm", 2, "mpm", "current"},
    {"mpm reference", 2, "mpm", "reference"},
    {"adaptive", 2, "adaptive", "current"},
    {"adaptive reference", 2, "adaptive", "reference"},
    {"pd", 3, "pd", "current"},
    {"mpm", 3, "mpm", "current"},
    {"mpm reference", 3, "mpm", "reference"},
    {"adaptive", 3, "adaptive", "current"},
    {"adaptive reference", 3, "adaptive", "reference"},
};

/* Writes the scene keys for the crack through half of block b and, with the adaptive method, for a peridynamic region
 * around it, a tenth of the volume. Writes nothing with method mpm. edge: of the block [m]. */
static void block_parts(FILE *to, const struct bench_block *b, double edge)
{
    const double low = 0.45 * edge, high = 0.55 * edge, middle = 0.5 * edge;
    if (strcmp(b->method, "mpm") == 0) return;
    if (b->dim == 2) {
        fprintf(to, "cracks: [{from: [%.9g, 0], to: [%.9g, %.9g]}]\n", middle, middle, middle);
        if (strcmp(b->method, "adaptive") == 0)
            fprintf(to, "pd: {region: {box: {from: [%.9g, 0], to: [%.9g, %.9g]}}}\n", low, high, edge);
        return;
    }
    fprintf(to, "cracks: [{polygon: [[%.9g, 0, 0], [%.9g, %.9g, 0], [%.9g, %.9g, %.9g], [%.9g, 0, %.9g]]}]\n", middle,
            middle, middle, middle, middle, edge, middle, edge);
    if (strcmp(b->method, "adaptive") == 0)
        fprintf(to, "pd: {region: {box: {from: [%.9g, 0, 0], to: [%.9g, %.9g, %.9g]}}}\n", low, high, edge, edge);
}

/* Returns the number of particles along the edge of block b of about `particles` particles, at least 12. */
static int64_t edge_of_block(const struct bench_block *b, double particles)
{
    const int64_t n = (int64_t)round(pow(particles, 1.0 / b->dim));
    return n > 12 ? n : 12;
}

/* Writes the scene of block b for timing. particles: approximate number of particles; steps, frames: numbers of time
 * steps and of frames. Every particle moves, because particles at rest may be skipped; displacements remain small, with
 * 1 m/s at the farthest corner. All grid cells of the reference frame have an edge of two spacings. With coarser cells
 * a run could only be stopped at steps at which all levels of cells have the same time, and parts of it could not be
 * timed. */
static void block_text(FILE *to, const struct bench_block *b, double particles, int64_t steps, int frames)
{
    const double spacing = 1e-3, step = 5e-8, edge = spacing * (double)edge_of_block(b, particles), rate = 1 / edge;
    fprintf(to, "name: block\nspace: %s\n%s", b->dim == 2 ? "plane stress" : "solid",
            b->dim == 2 ? "thickness: 1 mm\n" : "");
    fprintf(to, "method: %s\nduration: %.9g\ntime: {step: %.9g}\n", b->method, (double)steps * step, step);
    fprintf(to, "material: {young: 72e9, density: 2440, critical_stretch: 0.1}\nparticles: {spacing: %.9g}\n", spacing);
    fprintf(to, "mpm: {frame: %s%s}\noutput: {frames: %d, samples: 1}\n", b->frame,
            strcmp(b->frame, "reference") == 0 ? ", levels: 0" : "", frames);
    if (b->dim == 2)
        fprintf(
            to,
            "body: {box: {from: [0, 0], to: [%.9g, %.9g]}}\ninitial: [{velocity_gradient: [[%.9g, 0], [0, %.9g]]}]\n",
            edge, edge, rate, rate);
    else
        fprintf(to,
                "body: {box: {from: [0, 0, 0], to: [%.9g, %.9g, %.9g]}}\n"
                "initial: [{velocity_gradient: [[%.9g, 0, 0], [0, %.9g, 0], [0, 0, %.9g]]}]\n",
                edge, edge, edge, rate, rate, rate);
    block_parts(to, b, edge);
}

status bench_block_make(struct run *run, struct scene *s, const struct bench_block *b,
                        double approximate_particle_count, int64_t step_count, int frame_count, struct output *output)
{
    char text[2048];
    FILE *to = fmemopen(text, sizeof text, "w");
    if (!to) return status_set(FAILED, "bench: out of memory");
    block_text(to, b, approximate_particle_count, step_count, frame_count);
    fclose(to);
    *run = (struct run){0};
    *s = (struct scene){0};
    TRY(scene_read_text(s, text, strlen(text), "block", NULL, 0));
    status made = run_set_up_from_scene(run, s, output);
    run->report->quiet = true;
    if (made != OK) bench_engine_free(run, s);
    return made;
}
