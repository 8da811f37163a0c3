"""Compares two pictures region by region.

blender -b --factory-startup --python compare.py -- A REFERENCE prints the ratios of the regions'
means, the picture's top row first, and exits with 1 if one is too far from 1.
"""
import sys

import bpy
import numpy

columns, rows = 8, 5
tolerance = 0.05
# The red sphere's right rim, which the lamp grazes, and the crate's front, which is seen and lit at an
# angle. Cycles 3.4's Principled lays its specular layer upon a diffuse one without dimming that, and
# brightens it at grazing angles (Disney's diffuse): it gives back more than it gets. Here what the
# layer reflects does not reach the diffuse one. Where all is diffuse, the pictures agree there too.
# By row and column, from 0.
documented = {(2, 2): 0.1, (2, 6): 0.1}


def picture(file):
    image = bpy.data.images.load(file)
    image.colorspace_settings.name = "Linear"
    width, height = image.size
    values = numpy.empty(width * height * image.channels, numpy.float32)
    image.pixels.foreach_get(values)
    return values.reshape(height, width, image.channels)[::-1, :, :3]


def means(values):
    height, width, _ = values.shape
    regions = values.reshape(rows, height // rows, columns, width // columns, 3)
    return regions.mean(axis=(1, 3), dtype=numpy.float64)


files = sys.argv[sys.argv.index("--") + 1:]
ours, theirs = (means(picture(file)) for file in files)
ratio = ours.mean(axis=2) / theirs.mean(axis=2)
for row in ratio:
    print("  ".join(f"{value:.3f}" for value in row))
differing = [(row, column) for row in range(rows) for column in range(columns)
             if abs(ratio[row, column] - 1) > documented.get((row, column), tolerance)]
for row, column in differing:
    print(f"the region in row {row}, column {column} is {ratio[row, column]:.3f} of the reference's")
sys.exit(len(differing) > 0)
