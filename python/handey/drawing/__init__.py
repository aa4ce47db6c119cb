"""Pictures of slices and sections as SVG: figures of panels, and the marks in them."""

from handey.drawing.figure import Axis, Figure, Panel

__all__ = ["Axis", "Figure", "Panel"]
