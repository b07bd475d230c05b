// What has to be scrolled sideways can be reached by the keys, as long as it has to be, and fades where it goes on.

function follow(box) {
  const beyond = box.scrollWidth - box.clientWidth;
  if (beyond > 1) box.tabIndex = 0;
  else box.removeAttribute("tabindex");
  box.classList.toggle("goes-on", box.scrollLeft < beyond - 1);
}

const scrolled = new ResizeObserver((seen) => seen.forEach(({ target }) => follow(target)));

function reachable(root) {
  for (const box of root.querySelectorAll(".sheet, .line, .table, .told, .text pre, .text table")) {
    scrolled.observe(box);
    box.addEventListener("scroll", () => follow(box), { passive: true });
  }
}

reachable(document);
