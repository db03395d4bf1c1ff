"""The embedded engine: hard spheres from event to event, for streams whose contacts do not overlap in time."""

from peenflow.dem.event_driven.engine import EventDriven

__all__ = ["EventDriven"]
