// What has to be scrolled sideways can be reached by the keys, as long as it has to be.

const scrolled = new ResizeObserver((seen) => {
  for (const { target } of seen) {
    if (target.scrollWidth > target.clientWidth + 1) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }
});

function reachable(root) {
  const boxes = root.querySelectorAll(".sheet, .line, .table, .told, .text pre, .text table");
  boxes.forEach((box) => scrolled.observe(box));
}

reachable(document);
