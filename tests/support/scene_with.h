/* Reads a scene from a text with overrides. */
#ifndef CLEAVE_TESTS_SCENE_WITH
#define CLEAVE_TESTS_SCENE_WITH

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "scene/scene_read.h"

/* Reads a scene from `text` into *s with the overrides of its keys in `list`: at most 16 strings `key=value`, then
 * NULL. Returns the status of scene_read_text. Release s with scene_free if it is OK. */
static inline status scene_with(struct scene *s, const char *text, va_list list)
{
    enum { MOST = 16 };
    static char key[MOST][64];
    struct scene_override override[MOST];
    int n = 0;
    for (const char *one; (one = va_arg(list, const char *)) != NULL; n++) {
        const char *equal = strchr(one, '=');
        snprintf(key[n], sizeof key[n], "%.*s", (int)(equal - one), one);
        override[n] = (struct scene_override){key[n], equal + 1};
    }
    return scene_read_text(s, text, strlen(text), "test.yaml", override, n);
}

#endif
