// Examples and reports play where they stand: in a frame that is made when somebody asks for it.
"use strict";

{
  const PLAYER = document.currentScript.dataset.player;
  const frames = new Map();

  const address = async ({ scene, page }) => (scene === undefined ? `${page}#embed` : `${PLAYER}#embed&scene=${await packedText(scene)}`);

  const open = async (box, button) => {
    const frame = document.createElement("iframe");
    frame.title = button.title;
    frame.src = await address(box.dataset);
    box.append(frame);
    frames.set(frame.contentWindow, frame);
    return frame;
  };

  const addButton = (box) => {
    const button = document.createElement("button");
    let frame = null;
    button.type = "button";
    button.title = box.dataset.page === undefined ? "The example, to play with" : "The scene, to play with";
    const show = (is) => {
      button.textContent = is ? "Close" : "Play it here";
      button.setAttribute("aria-expanded", is);
    };
    button.addEventListener("click", async () => {
      if (frame) frames.delete(frame.contentWindow);
      frame?.remove();
      frame = frame ? null : await open(box, button);
      show(frame !== null);
    });
    show(false);
    box.append(button);
  };

  // A frame says how high it wants to be.
  addEventListener("message", ({ data, source }) => {
    const frame = frames.get(source);
    if (frame && Number.isFinite(data?.height)) frame.style.height = `${Math.min(Math.max(data.height, 120), 4000)}px`;
  });

  document.querySelectorAll("[data-scene], [data-page]").forEach(addButton);
}
