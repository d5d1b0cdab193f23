"""Parameter studies: many runs of one model, on any executor."""

from .sweep import sweep

__all__ = ["sweep"]
