// What scripts make of a page, or of a part of it that has come anew.

function mount(root, { plots, motions }) {
  root.querySelectorAll("[data-long]").forEach(foldTable);
  root.querySelectorAll(".cases").forEach((box) => new Tabs(box));
  for (const figure of root.querySelectorAll("figure[data-plot]")) new Plot(figure, plots[figure.dataset.plot]);
  for (const figure of root.querySelectorAll("figure[data-motion]")) {
    const player = new Player(figure, motions[figure.dataset.motion]);
    if (clock.value !== null) player.seek(clock.value);
  }
  reachable(root);
}

mount(document, DATA);
