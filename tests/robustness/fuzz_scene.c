/* Targets of fuzz.h: scenes and overrides. They are refused in one line with position and reason, or an accepted scene
 * is written, read back, and written again to an identical text. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "scene/scene.h"
#include "scene/scene_read.h"

static const char good[] =
    "name: plate\nspace: plane stress\nthickness: 10 mm\nduration: 1 us\nmethod: adaptive\n"
    "material: {young: 190 GPa, density: 7800 kg/m^3, energy_release_rate: 69 kJ/m^2}\n"
    "body:\n  - box: {from: [0, 0], to: [20 mm, 10 mm]}\n  - subtract: {disc: {centre: [5 mm, 5 mm], radius: 2 mm}}\n"
    "particles: {spacing: 1 mm}\nmpm: {shape: gimp}\ncracks: [{from: [10 mm, 5 mm], to: [20 mm, 5 mm]}]\n"
    "boundary: [{name: pull, velocity: [free, 1], region: {box: {from: [0, 9 mm], to: [20 mm, 10 mm]}}, time: {step: "
    "{until: 5 us}}}, {displacement: [free, 1e-3*y*t/(1 us)], face: y-, depth: 2 mm}]\n"
    "probes: [tip, point: {at: [1 mm, 1 mm]}, reaction: {boundary: pull}]\n";

static void judge(struct scene *s, status read)
{
    struct scene again = {0};
    const char *said = status_message();
    if (read == REFUSED && (!said[0] || strchr(said, '\n'))) fuzz_fail("refused without a line", said);
    if (read == FAILED) fuzz_fail("failed", said);
    if (read != OK) return;
    if (scene_read_text(&again, s->text, strlen(s->text), "echo", NULL, 0) != OK)
        fuzz_fail("what is written out is refused", status_message());
    if (strcmp(s->text, again.text) != 0) fuzz_fail("what is written out is read otherwise", again.text);
    scene_free(&again);
    scene_free(s);
}

void fuzz_scene(const uint8_t *bytes, size_t n)
{
    struct scene s = {0};
    status_set(OK, "%s", "");
    judge(&s, scene_read_text(&s, (const char *)bytes, n, "fuzz", NULL, 0));
}

void fuzz_override(const uint8_t *bytes, size_t n)
{
    enum { MOST = 6 };
    struct scene s = {0};
    struct scene_override o[MOST];
    int overrides = 0;
    char *text = malloc(n + 1), *rest = text;
    if (!text) return;
    memcpy(text, bytes, n), text[n] = '\0';
    for (char *line; overrides < MOST && (line = strsep(&rest, "\n"));) {
        char *value = strchr(line, '=');
        if (!value) continue;
        *value = '\0', o[overrides++] = (struct scene_override){line, value + 1};
    }
    status_set(OK, "%s", "");
    judge(&s, scene_read_text(&s, good, strlen(good), "fuzz", o, overrides));
    free(text);
}
