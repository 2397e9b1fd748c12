# SPDX-License-Identifier: GPL-3.0-or-later
"""A figure as an image, drawn once."""
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image


def drawn(figure: Figure, dpi: int) -> Image.Image:
    """The image, RGBA, that figure.savefig writes with this resolution (dots per inch). savefig draws a figure with a
    layout engine twice, and its PNG would be read again; here the engine is run, and then removed from the figure."""
    before = figure.dpi
    figure.set_dpi(dpi)
    canvas = FigureCanvasAgg(figure)
    engine = figure.get_layout_engine()
    if engine is not None:
        engine.execute(figure)
        figure.set_layout_engine("none")
    canvas.draw()
    figure.set_dpi(before)  # the figure may be drawn again
    return Image.fromarray(np.asarray(canvas.buffer_rgba()))
