/* `cleave bench peers`: compares a plate and a block in Cleave and in LAMMPS (peri/pmb, peri/lps), particle by
 * particle, alternately on one core. Both read the same positions, volumes and velocities; the micro-modulus is that of
 * Cleave.
 *
 * LAMMPS weights neighbours near the horizon by a ramp (here `cut-ramp`), with influence function 1/r for LPS. LPS with
 * K_L = 4 k2/9, G_L = 8 G/15 on a planar neighbourhood is the 2D law. LAMMPS creates bonds from the neighbour list of
 * the first `run 0`: pairs excluded at that time, by a type for each particle that a crack touches, never become bonds.
 * A second `run 0` lets LPS compute its strains before anything moves. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bench/common/bench.h"
#include "plot/gnuplot.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"
#include "step/report.h"
#include "peers.h"

/* STEPS: time steps of a run; ROUNDS: repetitions of a timed run; TEXT_ROOM: capacity of a scene [byte]. */
enum { STEPS = 200, ROUNDS = 3, TEXT_ROOM = 2048 };
#define FOLDER PEERS_FOLDER
#define SPACING 5e-4
/* Reach of bonds [spacings]: the usual one; one for which only the neighbours at sqrt(8) spacings are on the ramp;
 * nearest neighbours only. */
#define REACH_USUAL 3.015
#define REACH_EXACT 2.95342712474619
#define REACH_NEAREST 1.375

struct peer_case {
    const char *name, *law;    /* law: "pmb" or "lps" */
    double reach;              /* [spacings] */
    int dim, edge, edge_quick; /* particles along an edge */
    bool cracked, breaking, timed;
};
static const struct peer_case cases[] = {
    {"plate", "pmb", REACH_USUAL, 2, 100, 40, false, false, true},
    {"plate", "pmb", REACH_EXACT, 2, 100, 30, true, false, false},
    {"plate", "lps", REACH_USUAL, 2, 100, 40, false, false, true},
    {"plate", "lps", REACH_EXACT, 2, 100, 30, true, false, false},
    {"plate", "lps", REACH_NEAREST, 2, 100, 30, true, false, false},
    {"block", "pmb", REACH_USUAL, 3, 32, 10, false, false, true},
    {"block", "pmb", REACH_EXACT, 3, 16, 8, false, false, false},
    {"block", "lps", REACH_USUAL, 3, 32, 10, false, false, true},
    {"block", "lps", REACH_EXACT, 3, 16, 8, false, false, false},
    {"block", "lps", REACH_NEAREST, 3, 16, 8, false, false, false},
    {"plate breaking", "pmb", REACH_EXACT, 2, 100, 40, true, true, false},
    {"plate breaking", "lps", REACH_EXACT, 2, 100, 40, true, true, false},
};
enum { CASES = COUNT_OF(cases) };

struct peer_result {
    bool known;
    double particles, bonds, cut; /* directed bonds; bonds cut initially */
    double own, peer;             /* time of a step [s] */
    double bond_style;            /* the same with bond_style bpm/peri; measured, or derived from `peer` */
    /* Largest |u - u_LAMMPS| over largest |u|; sums of the share of broken bonds. */
    double difference, damage, damage_peer;
};

struct solution {
    double *place[DIM_MAX], *damage;
}; /* arrays are sorted by id */

static bool is_lps(const struct peer_case *c) { return c->law[0] == 'l'; }

static bool peer_installed(void)
{
    const char *list = getenv("PATH");
    while (list && *list) {
        char path[PATH_ROOM];
        const int length = (int)strcspn(list, ":");
        snprintf(path, sizeof path, "%.*s/lmp", length, list);
        if (access(path, X_OK) == 0) return true;
        list += length + (list[length] == ':');
    }
    return false;
}

/* ---- the scene --------------------------------------------------------------------------------------------------- */

/* Writes the scene of case c with `edge` particles along an edge: a uniform extension along x, with the lattice
 * slightly rotated so that no direction is special. No particles come into contact. */
static void scene_text(FILE *to, const struct peer_case *c, int edge)
{
    const double half = 0.5 * edge * SPACING, rate = c->breaking ? 3000 : 300, step = c->dim == 2 ? 4e-8 : 2e-8;
    fprintf(to, "name: peer\nspace: %s\n%sduration: %.17g\nmethod: pd\ntime: {step: %.17g}\n",
            c->dim == 2 ? "plane stress" : "solid", c->dim == 2 ? "thickness: 1 mm\n" : "", STEPS * step, step);
    if (is_lps(c)) fputs("model: ospd\n", to);
    fprintf(to, "material: {young: 192e9, %sdensity: 8000, critical_stretch: %g}\n", is_lps(c) ? "poisson: 0.3, " : "",
            c->breaking ? 0.02 : 10.0);
    fprintf(to, "particles: {spacing: %.17g, horizon: %.17g}\n", SPACING, c->reach);
    fprintf(to,
            "pd: {volume: cut-ramp, weights: uniform, calibration: lattice, surface: none, last_force: whole}\n"
            "contact: {%s}\noutput: {frames: 0, samples: 1}\n",
            is_lps(c) ? "between: none" : "law: pair, distance: lammps");
    if (c->dim == 2)
        fprintf(to,
                "body: {box: {from: [%.17g, %.17g], to: [%.17g, %.17g]}}\n"
                "initial: [{velocity_gradient: [[%g, %g], [%g, %g]]}]\n",
                -half, -half, half, half, rate, 0.3 * rate, 0.1 * rate, 0.8 * rate);
    else
        fprintf(to,
                "body: {box: {from: [%.17g, %.17g, %.17g], to: [%.17g, %.17g, %.17g]}}\n"
                "initial: [{velocity_gradient: [[%g, %g, 0], [0, %g, %g], [%g, 0, %g]]}]\n",
                -half, -half, -half, half, half, half, rate, 0.3 * rate, 0.8 * rate, 0.2 * rate, 0.1 * rate, rate);
    if (c->cracked) /* no bond passes through the ends of the cracks */
        fprintf(to, "cracks: [{from: [%.17g, %.17g], to: [%.17g, %.17g]}]\n", -0.1123 * edge * SPACING,
                -0.0312 * edge * SPACING, 0.1123 * edge * SPACING, 0.0357 * edge * SPACING);
}

/* Writes the scene of case c into text[TEXT_ROOM]. edge: particles along an edge. Returns FAILED if memory is
 * exhausted. */
static status peer_scene_text(char *text, const struct peer_case *c, int edge)
{
    FILE *to = fmemopen(text, TEXT_ROOM, "w");
    if (!to) return status_set(FAILED, "bench: out of memory");
    scene_text(to, c, edge);
    fclose(to);
    return OK;
}

static status peer_engine(struct run *run, struct scene *s, const struct peer_case *c, int edge)
{
    char text[TEXT_ROOM];
    TRY(peer_scene_text(text, c, edge));
    return bench_engine_make(run, s, "peer", text, NULL, 0);
}

/* ---- the input of LAMMPS ----------------------------------------------------------------------------------------- */

/* Finds the bonds that the cracks of the run cut, each pair of particles once, and returns their number.
 * type[particles]: gives each particle of such a bond a LAMMPS atom type of its own; types: number of types,
 * incremented for each; exclude: receives the LAMMPS commands that exclude these pairs. */
static int64_t cut_pairs(const struct run *run, int *type, int *types, FILE *exclude)
{
    const struct particles *p = &run->part;
    int32_t found[512];
    int64_t cut = 0;
    for (int64_t i = 0; i < p->n && run->source.cracks > 0; i++) {
        real X[DIM_MAX];
        particle_reference_position(p, i, X);
        const int n = cells_list_particles_near_point(&run->cells, p, X, run->source.family.cutoff, (int32_t)i, found,
                                                      COUNT_OF(found));
        for (int k = 0; k < n; k++) {
            const int32_t j = found[k];
            if (j < i || !precracks_cut_bond_between(run->source.crack, run->source.cracks, p, i, j)) continue;
            if (!type[i]) type[i] = ++*types;
            if (!type[j]) type[j] = ++*types;
            fprintf(exclude, "neigh_modify exclude type %d %d\n", type[i], type[j]);
            cut++;
        }
    }
    return cut;
}

static void write_data(FILE *to, const struct run *run, const int *type, int types, double half)
{
    const struct particles *p = &run->part;
    const char *box = "xlo xhi\0ylo yhi\0zlo zhi";
    fprintf(to, "particles\n\n%lld atoms\n%d atom types\n\n", (long long)p->n, types);
    for (int d = 0; d < DIM_MAX; d++) {
        const double far = d < p->dim ? 2 * half : 4 * SPACING;
        fprintf(to, "%.17g %.17g %s\n", -far, far, box + 8 * d);
    }
    fputs("\nAtoms\n\n", to);
    for (int64_t i = 0; i < p->n; i++)
        fprintf(to, "%d %d %.17g %.17g %.17g %.17g %.17g\n", p->id[i] + 1, type[i] ? type[i] : 1, p->volume0[i],
                p->mass[i] / p->volume0[i], p->X[0][i], p->X[1][i], p->dim > 2 ? p->X[2][i] : 0);
    fputs("\nVelocities\n\n", to);
    for (int64_t i = 0; i < p->n; i++)
        fprintf(to, "%d %.17g %.17g %.17g\n", p->id[i] + 1, p->v[0][i], p->v[1][i], p->dim > 2 ? p->v[2][i] : 0);
}

static void write_law(FILE *to, const struct run *run, const struct peer_case *c)
{
    const struct material *m = run->scene->material;
    const double horizon = run->source.family.horizon, limit = m->critical_stretch;
    fprintf(to, "pair_style peri/%s\npair_coeff * * ", c->law);
    if (!is_lps(c))
        fprintf(to, "%.17g %.17g %.17g 0.0\n", family_micro_modulus(&run->source.family, m), horizon, limit);
    else if (c->dim == 3)
        fprintf(to, "%.17g %.17g %.17g %.17g 0.0\n", m->c12 + 2 * m->shear / 3, m->shear, horizon, limit);
    else
        fprintf(to, "%.17g %.17g %.17g %.17g 0.0\n", 4 * (m->c12 + m->shear) / 9, 8 * m->shear / 15, horizon, limit);
}

static void write_script(FILE *to, const struct run *run, const struct peer_case *c, const char *exclude)
{
    fprintf(to, "units si\nboundary s s %c\natom_style peri\natom_modify map array sort 0 0.0\nneighbor %.17g bin\n",
            c->dim == 2 ? 'f' : 's', 0.3 * SPACING);
    fprintf(to, "lattice sc %.17g\nread_data " FOLDER "/particles.data\n", SPACING);
    write_law(to, run, c);
    fprintf(to, "%stimestep %.17g\nrun 0 post no\nrun 0 post no\n", exclude, run->clock.dt);
    if (exclude[0]) fputs("neigh_modify exclude none\n", to);
    fprintf(to,
            "fix 1 all nve\ncompute d all damage/atom\nthermo 1000000\nrun %d\n"
            "dump 1 all custom 1 " FOLDER "/particles.dump id x y z c_d\n"
            "dump_modify 1 sort id format float %%.17g\nrun 0 post no\n",
            STEPS);
}

static FILE *create(const char *name, status *s)
{
    FILE *to = fopen(path_join(FOLDER, name).text, "w");
    if (!to && *s == OK) *s = file_report_write_failure(path_join(FOLDER, name).text, errno);
    return to;
}

static status write_input(const struct run *run, const struct peer_case *c, int edge, struct peer_result *r)
{
    status s = OK;
    char *exclude = NULL;
    size_t length = 0;
    int types = 1, *type = NEW("peers.type", run->part.n, int);
    FILE *lines = memory_stream_open(&exclude, &length), *data = create("particles.data", &s),
         *script = create("in.lammps", &s);
    if (s == OK && lines) {
        r->cut = (double)cut_pairs(run, type, &types, lines);
        fflush(lines);
        write_data(data, run, type, types, 0.5 * edge * SPACING);
        write_script(script, run, c, exclude);
    }
    if (lines && fclose(lines) != 0 && s == OK) s = status_set(FAILED, "bench peers: out of memory");
    if (data && fclose(data) != 0 && s == OK) s = file_report_write_failure(FOLDER "/particles.data", errno);
    if (script && fclose(script) != 0 && s == OK) s = file_report_write_failure(FOLDER "/in.lammps", errno);
    free(exclude);
    memory_free(type);
    return s;
}

/* ---- both runs --------------------------------------------------------------------------------------------------- */

/* Reads positions and damage of n particles from the file that LAMMPS has written, and stores them in the arrays of s
 * in the order of ids. Returns FAILED if particles are missing. */
static status peer_solution(struct solution *s, int64_t n)
{
    char line[512];
    FILE *f = fopen(FOLDER "/particles.dump", "r");
    int64_t read = 0;
    while (f && fgets(line, sizeof line, f)) {
        long id;
        double x, y, z, damage;
        if (sscanf(line, "%ld %lf %lf %lf %lf", &id, &x, &y, &z, &damage) != 5 || id < 1 || id > n) continue;
        s->place[0][id - 1] = x, s->place[1][id - 1] = y, s->place[2][id - 1] = z, s->damage[id - 1] = damage;
        read++;
    }
    if (f) fclose(f);
    return read == n
               ? OK
               : status_set(FAILED, "bench peers: lmp has left %lld particles of %lld", (long long)read, (long long)n);
}

static void peers_compare(struct peer_result *r, const struct run *run, const struct solution *peer,
                          const real *damage_start)
{
    const struct particles *p = &run->part;
    double largest = 0, worst = 0;
    r->damage = r->damage_peer = 0;
    for (int64_t i = 0; i < p->n; i++) {
        const int32_t id = p->id[i];
        double u2 = 0, d2 = 0;
        for (int d = 0; d < p->dim; d++) {
            u2 += square(p->x[d][i] - p->X[d][i]);
            d2 += square(p->x[d][i] - peer->place[d][id]);
        }
        largest = fmax(largest, sqrt(u2)), worst = fmax(worst, sqrt(d2));
        /* LAMMPS counts only existing bonds: the damage here is relative to the bonds that the crack left. */
        if (damage_start[i] < 1) r->damage += (p->damage[i] - damage_start[i]) / (1 - damage_start[i]);
        r->damage_peer += peer->damage[id];
    }
    r->difference = worst / largest;
}

static status run_both(struct peer_result *r, const struct peer_case *c, int edge, struct solution *peer)
{
    struct scene s;
    struct run e;
    double spent = 0;
    TRY(peer_engine(&e, &s, c, edge));
    real *damage = NEW("peers.damage", e.part.n, real);
    array_copy(damage, e.part.damage, e.part.n, sizeof *damage);
    for (int d = 0; d < DIM_MAX; d++) peer->place[d] = NEW("peers.place", e.part.n, double);
    peer->damage = NEW("peers.damage", e.part.n, double);
    r->particles = (double)e.part.n;
    status ran = write_input(&e, c, edge, r);
    r->bonds = (double)e.bonds.n - 2 * r->cut;
    if (ran == OK) ran = run_advance_to_end_time(&e);
    if (ran == OK) ran = peer_run_lammps(".", FOLDER "/in.lammps", FOLDER "/log.lammps");
    if (ran == OK) ran = peer_read_seconds_per_step(FOLDER "/log.lammps", STEPS, &spent);
    if (ran == OK) ran = peer_solution(peer, e.part.n);
    if (ran == OK) {
        r->own = fmin(r->own, report_wall_clock_times(e.report, &e.timers).loop / STEPS),
        r->peer = fmin(r->peer, spent);
        /* In LAMMPS the last positions have already broken bonds. */
        e.kernels.bond_force(&e.bonds, &e.part, &e.source.limit, NULL);
        peers_compare(r, &e, peer, damage);
        r->known = true;
    }
    for (int d = 0; d < DIM_MAX; d++) memory_free(peer->place[d]);
    memory_free(peer->damage);
    memory_free(damage);
    bench_engine_free(&e, &s);
    return ran;
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Prints the result r of case c: numbers of particles and bonds, times of a step, and the difference between the
 * results of Cleave and LAMMPS. */
static void print_result(const struct peer_case *c, const struct peer_result *r)
{
    printf("  %-15s %s %8.5f %9.0f %10.0f %6.0f", c->name, c->law, c->reach, r->particles, r->bonds, r->cut);
    if (c->timed)
        printf(" %8.2f %8.2f %7.1f", 1e9 * r->own / r->bonds, 1e9 * r->peer / r->bonds, r->peer / r->own);
    else
        printf(" %8s %8s %7s", "", "", "");
    printf("   %8.1e", r->difference);
    if (c->breaking) printf("   damage %.6g, %.6g", r->damage, r->damage_peer);
    putchar('\n');
    fflush(stdout);
}

/* Measures the time of a step with bond_style bpm/peri if the installed LAMMPS has it; else derives it from the time of
 * pair_style peri by the ratios that its authors state. Prints a line for each timed case. result[CASES]: results of
 * the cases; quick: small cases. Returns FAILED if a run fails. */
static status bond_style_compare(struct peer_result *result, bool quick)
{
    char text[TEXT_ROOM];
    const bool measured = peer_has_bond_style();
    printf("  bond_style bpm/peri of LAMMPS (September 2026), %s:\n",
           measured ? "measured"
                    : "derived: pair_style peri over 3.6 (pmb) and 5.4 (lps), table 3 of its authors (pull "
                      "request 5045)");
    for (int k = 0; k < CASES; k++) {
        const struct peer_case *c = &cases[k];
        struct peer_result *r = &result[k];
        if (!c->timed) continue;
        r->bond_style = r->peer / peer_bond_style_speed_ratio(is_lps(c));
        if (measured) {
            TRY(peer_scene_text(text, c, quick ? c->edge_quick : c->edge));
            TRY(peer_export_and_time_scene(text, STEPS, &r->bond_style));
        }
        printf("    %s of %s: %.2f ns a bond, %.1f times as long as here\n", c->name, c->law,
               1e9 * r->bond_style / r->bonds, r->bond_style / r->own);
    }
    return OK;
}

static status peers_write_table(const struct peer_result *result)
{
    struct bench_table t;
    bench_table_make(
        &t, "",
        "case,law,dim,reach,particles,directed_bonds,bonds_pre_cut,ns_per_bond_step,ns_per_bond_step_lammps,"
        "time_ratio,ns_per_bond_step_bpm,difference,damage,damage_lammps");
    for (int k = 0; k < CASES; k++) {
        const struct peer_result *r = &result[k];
        if (!r->known) continue;
        const double timed = cases[k].timed ? 1 : NAN;
        const double row[] = {cases[k].dim,
                              cases[k].reach,
                              r->particles,
                              r->bonds,
                              r->cut,
                              timed * 1e9 * r->own / r->bonds,
                              timed * 1e9 * r->peer / r->bonds,
                              timed * r->peer / r->own,
                              timed * 1e9 * r->bond_style / r->bonds,
                              r->difference,
                              r->damage,
                              r->damage_peer};
        bench_table_append_text(&t, cases[k].name), bench_table_append_text(&t, cases[k].law);
        for (size_t i = 0; i < COUNT_OF(row); i++) bench_table_append_number(&t, row[i]);
    }
    status s = bench_write_result_tables("peers", &t, 1);
    bench_table_free(&t);
    return s;
}

static void peers_draw(FILE *to, const void *context)
{
    const struct peer_result *result = context;
    fputs("$t << EOD\n", to);
    for (int k = 0; k < CASES; k++)
        if (cases[k].timed && result[k].known)
            fprintf(to, "\"%s\\n%s\" %.6g %.6g\n", cases[k].name, cases[k].law, 1e9 * result[k].own / result[k].bonds,
                    1e9 * result[k].peer / result[k].bonds);
    fprintf(
        to,
        "EOD\nset title 'one core, no bond breaks'\nset ylabel 'ns per directed bond and step'\nset logscale y\n"
        "set style data histograms\nset style histogram clustered gap 1\nset style fill solid 0.85\nset boxwidth 0.9\n"
        "set xtics scale 0\nset yrange [0.1:200]\nset key top left\n"
        "plot $t using 2:xtic(1) lc rgb '%s' title 'here', '' using 3 lc rgb '%s' title 'LAMMPS', "
        "'' using ($0-0.17):2:(sprintf('%%.2f', $2)) with labels offset 0, 0.7 notitle, "
        "'' using ($0+0.17):3:(sprintf('%%.1f', $3)) with labels offset 0, 0.7 notitle\n",
        curve_colour[0], curve_colour[4]);
}

static status peers_measure(struct peer_result *result, bool quick)
{
    struct bench_child folder = {0};
    TRY(bench_create_results_folder());
    strcpy(folder.folder, FOLDER);
    status s = mkdir(FOLDER, 0777) == 0 || errno == EEXIST ? OK : file_report_write_failure(FOLDER, errno);
    printf("  %-15s %s %8s %9s %10s %6s %8s %8s %7s   %8s\n", "", "law", "reach", "particles", "bonds", "cut",
           "ns/bond", "LAMMPS", "ratio", "|u - u_L|");
    for (int k = 0; k < CASES && s == OK; k++) {
        const struct peer_case *c = &cases[k];
        result[k].own = result[k].peer = INFINITY;
        for (int r = 0; r < (c->timed && !quick ? ROUNDS : 1) && s == OK; r++) {
            struct solution peer;
            s = run_both(&result[k], c, quick ? c->edge_quick : c->edge, &peer);
        }
        if (s == OK) print_result(c, &result[k]);
    }
    if (s == OK) s = bond_style_compare(result, quick);
    bench_child_wait_and_remove_output(&folder);
    TRY(s);
    printf("  bonds break by pd.last_force: whole, as in LAMMPS; peri/lps keeps the weighted volume of intact "
           "families, so\n"
           "  results of lps differ once bonds break\n");
    TRY(peers_write_table(result));
    return bench_draw("peers", 800, 500, peers_draw, result);
}

status bench_peers(bool quick)
{
    printf("peers\n");
    if (!peer_installed()) {
        printf("  lmp is not installed (Debian, Ubuntu: apt-get install lammps): left out\n\n");
        return OK;
    }
    struct peer_result *result = NEW("bench.peers", CASES, struct peer_result);
    bench_print_machine(threads_set_count_and_bind_to_cores(1));
    status s = peers_measure(result, quick);
    threads_set_count_and_bind_to_cores(0);
    memory_free(result);
    return s;
}
