"""The shot stream by discrete elements: nozzles, deflector, facets → contacts. Engines sit behind `engine.Engine`."""
