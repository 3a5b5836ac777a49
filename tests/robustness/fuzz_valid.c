/* Target of fuzz.h: scenes of every space, method, model, shape, load and probe, composed by choices according to the
 * input bytes; most of them are valid. A run must end with finite results or state in one line why it does not. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/engine.h"
#include "fuzz.h"
#include "probes/diagnostics.h"
#include "step/report.h"
#include "scene/scene_read.h"

enum { STEPS = 12, TEXT = 8192 };

struct maker {
    const uint8_t *bytes;
    size_t n, at;
    char text[TEXT];
    size_t length;
    int dim;
};

/* Returns a number from 0 to below - 1 chosen by the next byte of m; 0 if all bytes have been used. */
static int choose(struct maker *m, int below) { return m->at < m->n ? m->bytes[m->at++] % below : 0; }

static void add(struct maker *m, const char *format, ...)
{
    va_list words;
    va_start(words, format);
    const int length = vsnprintf(m->text + m->length, TEXT - m->length, format, words);
    va_end(words);
    if (length > 0) m->length += (size_t)length < TEXT - m->length ? (size_t)length : TEXT - m->length - 1;
}

/* Appends one of the texts in `choices`, which are separated by |, to the scene of m. */
static void add_one(struct maker *m, const char *choices)
{
    int count = 1;
    for (const char *c = choices; *c; c++) count += *c == '|';
    for (int k = choose(m, count); k > 0; k--) choices = strchr(choices, '|') + 1;
    add(m, "%.*s", (int)strcspn(choices, "|"), choices);
}

/* Appends a vector [a, b, ..] with a component for each dimension, between low and high, to the scene of m. */
static void add_vector(struct maker *m, double low, double high)
{
    for (int d = 0; d < m->dim; d++) add(m, "%s%g", d ? ", " : "[", low + (high - low) * choose(m, 17) / 16);
    add(m, "]");
}

static void add_box(struct maker *m, const double *from, const double *to)
{
    add(m, "{box: {from: ");
    for (int d = 0; d < m->dim; d++) add(m, "%s%g", d ? ", " : "[", from[d]);
    add(m, "], to: ");
    for (int d = 0; d < m->dim; d++) add(m, "%s%g", d ? ", " : "[", to[d]);
    add(m, "]}}");
}

/* Appends a solid that is subtracted from a body or intersected with it, possibly moved, mirrored or repeated, to the
 * scene of m. */
static void add_cut(struct maker *m)
{
    add(m, ", {"), add_one(m, "subtract|subtract|intersect"), add(m, ": {");
    const char *const shapes[] = {
        "box: {from: [-1], to: [9]}",
        "polygon: {corners: [[0, 0], [9, 1], [8, 8], [4, 3]], round: 0.5}|ellipse: {centre: [3, 3], radii: [4, 2]}|"
        "ring: {centre: [3, 3], radius: 5, inner: 2}|region: cut",
        "tube: {from: [0, 0, 0], to: [5, 5, 5], radius: 3, inner: 1}|"
        "cone: {from: [0, 0, 0], to: [3, 0, 6], from_radius: 3}|"
        "extrude: {shape: {ring: {centre: [2, 2], radius: 3, inner: 1}}, along: y, from: 0, to: 4}|"
        "torus: {centre: [2, 2, 2], axis: [1, 0, 1], radius: 2, section: 1}|region: cut"};
    const char *const turns[] = {"|, move: [2]|, mirror: {point: [3], normal: [1]}",
                                 "|, rotate: {angle: 40 deg}|, pattern: {ring: {count: 3, centre: [4, 4]}}|, pattern: "
                                 "{grid: {count: [2, 2], step: [5, 5]}}|, mirror: {point: [3, 3], normal: [1, 2]}",
                                 "|, rotate: {angle: 1 rad, axis: [1, 1, 0]}|, pattern: {ring: {count: 3, centre: "
                                 "[3, 3, 0]}}|, move: [1, 1, 1]"};
    add_one(m, shapes[m->dim - 1]), add_one(m, turns[m->dim - 1]);
    add(m, "}"), add_one(m, turns[m->dim - 1]), add(m, "}");
}

/* Appends materials, a region and one or two bodies to the scene of m. The spacing is 1 m; waves travel about one
 * spacing per second. edge[dim]: receives the edge lengths of the bodies [m]. */
static void add_bodies(struct maker *m, double *edge)
{
    static const double zero[DIM_MAX];
    double behind[DIM_MAX], end[DIM_MAX];
    const int most = m->dim == 1 ? 60 : m->dim == 2 ? 16 : 7, bodies = 1 + choose(m, 4) / 3;
    for (int d = 0; d < m->dim; d++) edge[d] = 1 + choose(m, most);
    for (int d = 0; d < m->dim; d++) behind[d] = d ? 0 : edge[0] + choose(m, 3), end[d] = behind[d] + edge[d];
    add(m, "materials:\n");
    for (int k = 0; k < 2; k++) {
        add(m, "  - {name: m%d, young: %s, density: 1", k, k ? "2" : "1");
        add_one(m, "|, critical_stretch: 0.02|, energy_release_rate: 1e-4|, toughness: 0.01|, yield_stress: 0.01|, "
                   "poisson: 0.3");
        add(m, "}\n");
    }
    add(m, "regions: {cut: [{ball: {centre: "), add_vector(m, 0, 4), add(m, ", radius: 2}}]}\n");
    add(m, "bodies:\n  - {name: a, material: m0, shape: [");
    add_box(m, zero, edge);
    if (choose(m, 4) == 3) {
        add(m, ", {subtract: {ball: {centre: ");
        add_vector(m, 0, edge[0]);
        add(m, ", radius: 2}}}");
    }
    if (choose(m, 4) == 3) add_cut(m);
    add(m, "]}\n");
    if (bodies == 1) return;
    add(m, "  - {name: b, material: m1, shape: [");
    add_box(m, behind, end);
    add(m, "], velocity: ");
    add_vector(m, -0.2, 0.1);
    add(m, "}\n");
}

static void add_methods(struct maker *m)
{
    add(m, "method: "), add_one(m, "adaptive|pd|mpm|adaptive"), add(m, "\nmodel: "), add_one(m, "bond|bond|ospd|mospd");
    add(m, "\nparticles: {spacing: 1, horizon: "), add_one(m, "3.015|3|2.015|4.2|1.5|6.015"),
        add_one(m, "|, irregularity: 0.2|, irregularity: 1");
    add(m, "}\npd: {volume: "), add_one(m, "whole|ramp|cut-ramp"),
        add_one(m, "|, calibration: continuum|, calibration: vmpd");
    add_one(m, "|, surface: none|, surface: volume"), add_one(m, "|, weights: isotropic"), add(m, "}\nmpm: {cell: ");
    add_one(m, "2|1|1.5|3|8"), add_one(m, "|, shape: linear|, shape: cpgimp|, shape: quadratic|, shape: cubic");
    add_one(m, "|, transfer: flip|, transfer: apic"), add_one(m, "|, frame: current|, frame: reference"),
        add_one(m, "|, strain: small");
    add(m, "}\n"), add_one(m, "|coupling: handshake\n|coupling: pm\n|coupling: pg\n|coupling: pmg\n|coupling: pgg\n");
    add_one(m, "|conversion: {stress: 0.01}\n|conversion: {stress: 0.01, reversion: true}\n|conversion: {criteria: "
               "none}\n|conversion: {block: false}\n");
    add_one(m, "||time: {safety: 0.2}\n|time: {safety: 1.9}\n|time: {step: 0.1}\n|time: {active_set: false}\n");
}

static void add_loads(struct maker *m, const double *edge)
{
    const double low[DIM_MAX] = {-1, -1, -1}, high[DIM_MAX] = {1.5, edge[1] + 1, edge[2] + 1};
    add(m, "boundary:\n  - {name: c0, fixed: all, region: "), add_box(m, low, high), add(m, "}\n");
    if (choose(m, 2)) {
        add(m, "  - {name: c1, "), add_one(m, "traction: |velocity: |displacement: |body_force: ");
        add_vector(m, -0.05, 0.05);
        add_one(m, ", face: x+|, face: y-|, face: x+, depth: 1|");
        add_one(m, "|, time: {step: {until: 2}}|, time: {ramp: {until: 5}}|, time: {pulse: {from: 0, until: 3}}"),
            add(m, "}\n");
    }
    add_one(m, "||  - {mirror: {axis: x, at: 0}}\n");
    add(m, "initial:\n  - {velocity: "), add_vector(m, -0.1, 0.1), add(m, "}\n");
    if (m->dim == 2 && choose(m, 2)) {
        add(m, "cracks:\n  - {from: "), add_vector(m, 0, edge[0]), add(m, ", to: "), add_vector(m, 0, edge[1]),
            add(m, "}\n");
    }
    add(m, "probes: ["),
        add_one(m, "tip|break|energy|momentum|tip, break, energy|patch|reaction: {boundary: c0}|rigid|spall"),
        add(m, "]\n");
    add(m, "output: {frames: 2, samples: 1000000}\n");
}

/* Ends the fuzzer with a message (fuzz_fail) if positions, velocities, stresses or balances of the run are not finite
 * or its damage is not within 0 and 1. when: text for the message. */
static void judge(const struct run *run, const char *when)
{
    const struct particles *p = &run->part;
    for (int64_t i = 0; i < p->n; i++) {
        for (int d = 0; d < p->dim; d++)
            if (!isfinite(p->x[d][i]) || !isfinite(p->v[d][i]))
                fuzz_fail("a place or a velocity that is no number", when);
        for (int k = 0; k < symmetric_tensor_component_count(p->dim); k++)
            if (!isfinite(p->stress[k][i])) fuzz_fail("a stress that is no number", when);
        if (!(p->damage[i] >= -1e-9 && p->damage[i] <= 1 + 1e-9)) fuzz_fail("damage is not within 0 and 1", when);
    }
    if (!isfinite(run->diagnostics->now.balance_error) || !isfinite(run->diagnostics->now.momentum_error))
        fuzz_fail("a balance that is no number", when);
}

static void run(const char *text)
{
    struct scene s = {0};
    struct run e = {0};
    status_set(OK, "%s", "");
    status done = scene_read_text(&s, text, strlen(text), "valid", NULL, 0);
    if (done == OK) {
        done = run_set_up_from_scene(&e, &s, NULL);
        e.report->quiet = true;
        if (done == OK) judge(&e, "at the start");
        if (e.clock.steps > STEPS) e.clock.steps = STEPS;
        if (done == OK && (done = run_advance_to_end_time(&e)) == OK) judge(&e, "at the end");
        run_free_memory(&e);
        scene_free(&s);
    }
    if (done != OK && (!status_message()[0] || strchr(status_message(), '\n')))
        fuzz_fail("ended without a line", status_message());
}

void fuzz_valid(const uint8_t *bytes, size_t n)
{
    static struct maker m;
    double edge[DIM_MAX] = {1, 1, 1};
    m = (struct maker){.bytes = bytes, .n = n};
    m.dim = 1 + (choose(&m, 4) + 1) % 3;
    add(&m, "space: "), add_one(&m, m.dim == 1 ? "line" : m.dim == 3 ? "solid" : "plane stress|plane strain");
    add(&m, "\n%sduration: 40\n", m.dim == 2 ? "thickness: 1\n" : "");
    add_methods(&m);
    add_bodies(&m, edge);
    add_loads(&m, edge);
    if (getenv("FUZZ_SHOW")) fputs(m.text, stderr);
    run(m.text);
}
