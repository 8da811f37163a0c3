// Scenes with faulty values: their error messages and places.
#include "catch.hpp"
#include "scene_faults.hpp"

TEST_CASE("Bad values are located errors") {
  check_all({
      {"camera: {fov: 180}",
       "scene.yaml:1:15: error: 'fov' of camera must be greater than 0 and less than 180, not 180"},
      {"camera: {fov: .nan}",
       "scene.yaml:1:15: error: 'fov' of camera must be a finite number, not .nan"},
      {"camera: {fov: -.inf}",
       "scene.yaml:1:15: error: 'fov' of camera must be a finite number, not -.inf"},
      {"camera: {fov: \"45\"}",
       "scene.yaml:1:15: error: 'fov' of camera must be a number, not '45'"},
      {"camera: {fov: [45]}",
       "scene.yaml:1:15: error: 'fov' of camera must be a number, not a list of 1"},
      {"camera: {fov:}", "scene.yaml:1:10: error: 'fov' of camera must be a number, not nothing"},
      {"camera: {position: [0, 1]}",
       "scene.yaml:1:20: error: 'position' of camera must be a list of 3 numbers, not a list of 2"},
      {"camera: {position: [0, 1, 1e38]}",
       "scene.yaml:1:27: error: 'position' of camera must be between -1e+18 and 1e+18, not 1e38"},
      {"camera: {position: [0, 1, 1e999]}",
       "scene.yaml:1:27: error: 'position' of camera must be between -1e+18 and 1e+18, not 1e999"},
      {"camera: {position: [0, 0, 0]}", "scene.yaml:1:9: error: camera looks at its own position"},
      {"camera: {position: [0, 1, 0]}",
       "scene.yaml:1:9: error: 'up' of camera is parallel to the viewing direction"},
      {"camera: {up: [0, 0, 0]}", "scene.yaml:1:14: error: 'up' of camera must not be zero"},
      {"camera: {type: fisheye}",
       "scene.yaml:1:16: error: unknown type 'fisheye' of camera; available options are: "
       "perspective, orthographic"},
      {"camera: {type: orthographic, height: 0}",
       "scene.yaml:1:38: error: 'height' of camera must be greater than 0, not 0"},
      {"film: {width: 100000, height: 100000}",
       "scene.yaml:1:15: error: 'width' of film must be a whole number between 1 and 65536, not "
       "100000\n"
       "scene.yaml:1:31: error: 'height' of film must be a whole number between 1 and 65536, not "
       "100000"},
      {"film: {width: 60000, height: 60000}",
       "scene.yaml:1:15: error: a film of 60000 x 60000 pixels is larger than the limit of "
       "268435456 pixels"},
      {"film: {width: 1.5}",
       "scene.yaml:1:15: error: 'width' of film must be a whole number, not 1.5"},
      {"film: {width: 64, height: 64, crop: [0, 65, 0, 64]}",
       "scene.yaml:1:41: error: 'crop' of film must be a whole number between 0 and 64, not 65"},
      {"film: {crop: [5, 5, 0, 4]}", "scene.yaml:1:14: error: 'crop' of film holds no pixel"},
      {"film: {filter: boks}",
       "scene.yaml:1:16: error: unknown filter 'boks' of film; available "
       "options are: blackman_harris, box"},
      {"film: {channels: [albedo, dept]}",
       "scene.yaml:1:27: error: unknown channel 'dept' of film; did you mean 'depth'? Available "
       "options are: albedo, normal, depth, variance"},
      {"render: {samples: -1}",
       "scene.yaml:1:19: error: 'samples' of render must be a whole number between 1 and "
       "1073741824, not -1"},
      {"render: {seed: 18446744073709551616}",
       "scene.yaml:1:16: error: 'seed' of render must be a whole number between 0 and "
       "18446744073709551615, not 18446744073709551616"},
      {"render: [1]", "scene.yaml:1:9: error: render must be a map, not a list of 1"},
      {"meshes: {}", "scene.yaml:1:9: error: meshes must be a list, not a map"},
      {"rendre: {}",
       "scene.yaml:1:1: error: unknown key 'rendre' in the scene; did you mean "
       "'render'?"},
  });
}

TEST_CASE("Bad materials and textures are located errors") {
  check_all({
      {"materials: {white: {reflectance: 0.5}}",
       "scene.yaml:1:20: error: missing key 'type' in material 'white'; available options are: "
       "diffuse, mirror, glass, metal, plastic, principled"},
      {"materials: {white: {type: difuse}}",
       "scene.yaml:1:27: error: unknown type 'difuse' of material 'white'; did you mean "
       "'diffuse'? Available options are: diffuse, mirror, glass, metal, plastic, principled"},
      {"materials: {white: {type: diffuse, reflectance: [1, 1, 1.01]}}",
       "scene.yaml:1:56: error: 'reflectance' of material 'white' must be between 0 and 1, not "
       "1.01"},
      {"materials: {white: {type: diffuse, reflectance: \"#12345g\"}}",
       "scene.yaml:1:49: error: 'reflectance' of material 'white' must be a color ([r, g, b], a "
       "number or \"#rrggbb\"), not '#12345g'"},
      {"materials: {g: {type: glass, ior: 0}}",
       "scene.yaml:1:35: error: 'ior' of material 'g' must be greater than 0, not 0"},
      {"materials: {m: {type: metal, preset: Cu, eta: 1}}",
       "scene.yaml:1:47: error: material 'm' takes either 'preset' or 'eta' and 'k'"},
      {"materials: {m: {type: metal, preset: Pb}}",
       "scene.yaml:1:38: error: unknown preset 'Pb' of material 'm'; available "
       "options are: Au, Ag, Cu, Al, Fe, gold, silver, copper, aluminum, iron"},
      {"materials: {m: {type: diffuse, reflectance: {texture: wood}}}",
       "scene.yaml:1:55: error: unknown texture 'wood' in 'texture' of 'reflectance' of material "
       "'m'; there are none"},
      {"materials: {m: {type: diffuse, reflectance: {scale: 1}}}",
       "scene.yaml:1:45: error: 'reflectance' of material 'm' takes either 'texture' or 'image'"},
      {"materials: {m: {type: diffuse, reflectance: {image: no.png}}}",
       "scene.yaml:1:53: error: file 'no.png' does not exist"},
      {"materials: {m: {type: diffuse, reflectance: {image: scene.yaml}}}",
       "scene.yaml:1:53: error: cannot read image 'scene.yaml': its first bytes match no supported "
       "picture format; supported are PNG, JPEG, EXR, Radiance HDR, TIFF, BMP, "
       "WebP, TGA"},
      {"textures: {t: {type: image, file: .}}", "scene.yaml:1:35: error: '.' is a directory"},
  });
}

TEST_CASE("Bad meshes are located errors") {
  check_all({
      {"meshes: [{name: floor}]",
       "scene.yaml:1:10: error: mesh 'floor' takes either 'shape' or 'file'"},
      {"meshes: [{shape: box, file: a.obj}]",
       "scene.yaml:1:10: error: mesh 1 takes either 'shape' or 'file'"},
      {"meshes: [{shape: ball, size: 3}]",
       "scene.yaml:1:18: error: unknown shape 'ball' of mesh 1; available options are: rectangle, "
       "disk, box, sphere, cylinder, cone, torus, height_field"},
      {"meshes: [{shape: sphere, size: 3}]",
       "scene.yaml:1:26: error: unknown key 'size' in mesh 1; available keys are: name, material, "
       "transform, repeat, scatter, shape, file, radius, segments, rings"},
      {"meshes: [{shape: torus, radius: 0.1}]",
       "scene.yaml:1:33: error: 'tube_radius' of mesh 1 must not be larger than the radius"},
      {"meshes: [{name: a, file: nothing.obj}]",
       "scene.yaml:1:26: error: file 'nothing.obj' does not exist"},
      {"meshes: [{name: a, file: scene.yml}]",
       "scene.yaml:1:26: error: file 'scene.yml' does not exist; did you mean 'scene.yaml'?"},
      {"meshes: [{name: a, file: .}]", "scene.yaml:1:26: error: '.' is a directory"},
      {"meshes: [{name: a, file: /dev/zero}]",
       "scene.yaml:1:26: error: '/dev/zero' is not a regular file"},
      {"materials: {white: {type: diffuse}}\nmeshes: [{shape: box, material: whit}]",
       "scene.yaml:2:33: error: unknown material 'whit' in 'material' of mesh 1; did you mean "
       "'white'?"},
      {"meshes: [{name: a, shape: box}, {name: a, shape: box}]",
       "scene.yaml:1:40: error: duplicate mesh name 'a'; the first is on line 1"},
      {"meshes: [{shape: height_field, heights: [[1, 2], [3]]}]",
       "scene.yaml:1:50: error: the rows of 'heights' of mesh 1 must be of one length"},
      {"meshes: [{shape: sphere, segments: 8192, rings: 8192}]",
       "scene.yaml:1:18: error: mesh 1 brings the scene to more than 100000000 triangles"},
  });
}

TEST_CASE("Bad transforms are located errors") {
  const auto transform = [](const std::string& steps) {
    return errors_of("meshes: [{shape: box, transform: " + steps + "}]");
  };
  CHECK(transform("[{scale: 0}]") ==
        "scene.yaml:1:35: error: transform of mesh 1 is singular: it leaves no volume\n");
  CHECK(transform("[{scale: [1, 0, 1]}]") ==
        "scene.yaml:1:35: error: transform of mesh 1 is singular: it leaves no volume\n");
  CHECK(transform("{matrix: [1,2,3,0, 2,4,6,0, 1,1,1,0, 0,0,0,1]}") ==
        "scene.yaml:1:34: error: transform of mesh 1 is singular: it leaves no volume\n");
  CHECK(transform("{matrix: [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]}") ==
        "scene.yaml:1:43: error: 'matrix' of mesh 1 must end with the row 0, 0, 0, 1\n");
  CHECK(transform("{matrix: [1, 0]}") ==
        "scene.yaml:1:43: error: 'matrix' of mesh 1 must be a list of 16 numbers, not a list of "
        "2\n");
  CHECK(transform("[{rotate: {axis: w, angle: 3}}]") ==
        "scene.yaml:1:51: error: unknown axis 'w' of rotate of mesh 1; did you mean 'x'? Available "
        "options are: x, y, z\n");
  CHECK(transform("[{rotate: {axis: [0, 0, 0], angle: 3}}]") ==
        "scene.yaml:1:51: error: 'axis' of rotate of mesh 1 must not be zero\n");
  CHECK(transform("[{rotate: {axis: y}}]") ==
        "scene.yaml:1:44: error: missing key 'angle' in rotate of mesh 1\n");
  CHECK(transform("{translate: [0, 0, 0], scale: 2}") ==
        "scene.yaml:1:34: error: a step of the transform of mesh 1 must have one key, not 2: "
        "several steps are a list\n");
  CHECK(transform("[{look_at: {to: [0, 5, 0]}}]") ==
        "scene.yaml:1:50: error: look_at of mesh 1 has no direction: 'to' is at 'from', or 'up' is "
        "parallel\n");
  CHECK(transform("[{scale: 1e15}, {scale: 1e15}]") ==
        "scene.yaml:1:10: error: mesh 1 reaches farther than 1e18 m from the origin\n");
  CHECK(transform("[{scale: 1.0e-30}]").empty());
}

TEST_CASE("Bad copies are located errors") {
  check_all({
      {"meshes: [{shape: box, repeat: {type: line, count: 0, step: [1, 0, 0]}}]",
       "scene.yaml:1:51: error: 'count' of repeat of mesh 1 must be a whole number between 1 and "
       "4294967295, not 0"},
      {"meshes: [{shape: box, repeat: {type: line, count: 30000000, step: [1, 0, 0]}}]",
       "scene.yaml:1:51: error: more than 20000000 instances in the scene"},
      {"meshes: [{shape: box, repeat: [{type: line, count: 5000, step: [1, 0, 0]}, {type: ring, "
       "count: 5000}]}]",
       "scene.yaml:1:76: error: more than 20000000 instances"},
      {"meshes: [{shape: box, repeat: {type: grid, count: [1.5, 1, 1]}}]",
       "scene.yaml:1:51: error: 'count' of repeat of mesh 1 must be whole numbers"},
      {"meshes: [{shape: box, scatter: {count: 3, over: lawn}}]",
       "scene.yaml:1:49: error: unknown mesh 'lawn' in 'over' of scatter of mesh 1; there are "
       "none: a mesh must come before the meshes that name it"},
      {"meshes: [{shape: box, scatter: {count: 3, scale: [2, 1]}}]",
       "scene.yaml:1:50: error: 'scale' of scatter of mesh 1 must rise: [smallest, largest]"},
      {"meshes: [{shape: sphere, segments: 1000, rings: 500, repeat: {type: line, count: 1000, "
       "step: [1, 0, 0]}}]",
       "scene.yaml:1:10: error: mesh 1 brings the scene to more than 100000000 triangles"},
  });
}

TEST_CASE("Bad lights and influence areas are located errors") {
  check_all({
      {"lights: [{name: a, type: point, intensity: -1}]",
       "scene.yaml:1:44: error: 'intensity' of light 'a' must be at least 0, not -1"},
      {"lights: [{name: a, type: point}, {name: a, type: point}]",
       "scene.yaml:1:41: error: duplicate light name 'a'; the first is on line 1"},
      {"lights: [{name: camera, type: point}]",
       "scene.yaml:1:17: error: a light cannot be named 'camera': influence areas use this name "
       "for the camera"},
      {"lights: [{type: directional, direction: [0, 0, 0]}]",
       "scene.yaml:1:41: error: 'direction' of light 1 must not be zero"},
      {"lights: [{type: area, radiance: 3}]",
       "scene.yaml:1:10: error: light 1 takes either 'shape' or 'file'"},
      {"influence_areas: on",
       "scene.yaml:1:18: error: unknown influence_areas 'on' of the scene; available "
       "options are: auto, off"},
      {"influence_areas: [{type: plane, light: sun}]",
       "scene.yaml:1:40: error: unknown light 'sun' in 'light' of influence area 1; there are "
       "none"},
      {"lights: [{name: sun, type: directional}]\n"
       "influence_areas: [{type: plane, light: sum}]",
       "scene.yaml:2:40: error: unknown light 'sum' in 'light' of influence area 1; did you mean "
       "'sun'?"},
      {"lights: [{name: sun, type: directional}]\n"
       "influence_areas: [{type: plane, light: sun, size: [0, 1]}]",
       "scene.yaml:2:52: error: 'size' of influence area 1 must be greater than 0, not 0"},
      {"lights: [{name: sun, type: directional}]\n"
       "influence_areas: [{type: plane, light: sun, depth: .inf}]",
       "scene.yaml:2:52: error: 'depth' of influence area 1 must be a finite number, not .inf"},
      {"lights: [{name: sun, type: directional}]\n"
       "influence_areas: [{type: point, light: sun}]",
       "scene.yaml:2:40: error: the rays of 'sun' do not meet in a point: a point area takes a "
       "point or spot light, or a perspective camera without an aperture"},
      {"camera: {type: perspective, aperture_radius: 0.1}\n"
       "influence_areas: [{type: point, light: camera}]",
       "scene.yaml:2:40: error: the rays of 'camera' do not meet in a point: a point area takes a "
       "point or spot light, or a perspective camera without an aperture"},
      {"influence_areas: [{type: plane, light: camera}]",
       "scene.yaml:1:40: error: the rays of 'camera' are not parallel: a plane area takes a "
       "directional light or an orthographic camera"},
      {"influence_areas: [{type: point, light: camera, fov: [90, 180]}]",
       "scene.yaml:1:58: error: 'fov' of influence area 1 must be greater than 0 and less than "
       "180, not 180"},
      {"influence_areas: [{type: point, light: camera, fov: [0, 90]}]",
       "scene.yaml:1:54: error: 'fov' of influence area 1 must be greater than 0 and less than "
       "180, not 0"},
      {"influence_areas: [{type: point, light: camera, near: 2, far: 2}]",
       "scene.yaml:1:62: error: 'near' of influence area 1 must be less than 'far'"},
      {"influence_areas: [{type: point, light: camera, forward: [0, 0, 0]}]",
       "scene.yaml:1:57: error: 'forward' of influence area 1 must not be zero"},
      {"acceleration: {heuristic: paah}",
       "scene.yaml:1:27: error: unknown heuristic 'paah' of acceleration; did you mean 'pah'? "
       "Available options are: auto, sah, pah, mean_direction"},
      {"acceleration: {max_leaf_triangles: 33}",
       "scene.yaml:1:36: error: 'max_leaf_triangles' of acceleration must be a whole number "
       "between "
       "1 and 32, not 33"},
      {"acceleration: {memory: 2}",
       "scene.yaml:1:24: error: 'memory' of acceleration must be a number greater than 0 and a "
       "unit "
       "(B, KiB, MiB, GiB, TiB, KB, MB, GB, TB), such as '2 GiB', not 2"},
      {"acceleration:\n  memory: 0 GiB",
       "scene.yaml:2:11: error: 'memory' of acceleration must be a number greater than 0 and a "
       "unit "
       "(B, KiB, MiB, GiB, TiB, KB, MB, GB, TB), such as '2 GiB', not '0 GiB'"},
      {"acceleration: {memory: [2 GiB]}",
       "scene.yaml:1:24: error: 'memory' of acceleration must be a number greater than 0 and a "
       "unit "
       "(B, KiB, MiB, GiB, TiB, KB, MB, GB, TB), such as '2 GiB', not a list of 1"},
  });
}
