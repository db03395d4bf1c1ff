"""The `translate` stage: contacts to impacts, impacts to the FE deck."""
