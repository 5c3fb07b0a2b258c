#pragma once

// The kinds of light, one header each. A kind is a shape, together with these overloads:
//
//     LightTypes<Shape, F>          what the functions below hand to each other
//     see                           the light from a point: what of it is lit
//     form_factors, integrate_lobe  its U in closed form: of the diffuse and the glossy lobe
//     bound_form_factor             both over a ball of points and of normals; and the shape's
//                                   `center` and `radius`, a ball around it
//     measure, has_places           prepares the choice of points on it
//     begin_place, end_place        a point for two random numbers, in two steps: loops take
//                                   several blocks of lanes through each
//     place_density                 of these points over directions, at any place
//     intersect                     where a direction meets it
//     place_origin                  what places are relative to, from the point and in the world
//     end_of_ray                    how far a shadow ray towards it runs
//     LightOutline<Shape>           the light from the eye: for the pass that draws lights
//     see_outline, misses_tile      makes it
//     covers, outline_depth         which pixels it covers, and how far away
//
// and its lines in core/light/light_set.h.

#include "shadow/polygon_kind.h"
