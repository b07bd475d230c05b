// Long tables that fold, cases as tabs, formulas that fit.

function foldTable(box) {
  const rows = box.querySelectorAll("tbody tr").length;
  const hidden = box.querySelectorAll("tr.more").length;
  const line = make("p", { class: "unfold note" });
  const words = make("span", {}, line);
  const button = make("button", { type: "button", "aria-expanded": "false" }, line);
  const set = (folded) => {
    box.classList.toggle("folded", folded);
    button.setAttribute("aria-expanded", String(!folded));
    button.textContent = folded ? `Show all ${rows} rows` : `Show the first ${rows - hidden} rows`;
    words.textContent = folded ? `${hidden} more rows. ` : "";
  };
  button.addEventListener("click", () => set(!box.classList.contains("folded")));
  box.append(line);
  set(true);
}

/** Cases as tabs: one is shown, arrow keys go to the next; in print all stand below each other. */
class Tabs {
  constructor(box) {
    this.panels = [...box.querySelectorAll(":scope > .case")];
    const list = make("div", { class: "tabs", role: "tablist", "aria-label": "Cases" });
    this.tabs = this.panels.map((panel, i) => this.addTab(list, panel, i));
    box.prepend(list);
    list.addEventListener("keydown", (event) => this.type(event));
    chosenCase.listen(this, (index) => this.show(index));
    this.show(0);
  }

  addTab(list, panel, i) {
    const heading = panel.querySelector("h4");
    const tab = make("button", { type: "button", role: "tab", id: `${panel.id}-tab`, "aria-controls": panel.id }, list);
    tab.append(...[...heading.childNodes].map((node) => node.cloneNode(true)));
    panel.setAttribute("role", "tabpanel");
    tab.addEventListener("click", () => this.choose(i));
    return tab;
  }

  choose(index) {
    this.show(index);
    chosenCase.set(index, this);
  }

  show(index) {
    this.index = index;
    this.tabs.forEach((tab, i) => {
      tab.setAttribute("aria-selected", String(i === index));
      tab.tabIndex = i === index ? 0 : -1;
      this.panels[i].classList.toggle("away", i !== index);
    });
  }

  type(event) {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    this.choose((this.index + by + this.tabs.length) % this.tabs.length);
    this.tabs[this.index].focus();
  }
}

// Formulas that no line can hold are set smaller where the page is narrow, as long as they can be read.

const LEAST_SIZE = 11;

function fitMath(math) {
  math.style.fontSize = "";
  const box = math.closest(".line, td, th, li, dd, p");
  if (!box || math.getClientRects().length === 0) return;
  const [inner, outer] = [math.getBoundingClientRect(), box.getBoundingClientRect()];
  if (inner.right <= outer.right) return;
  const size = (parseFloat(getComputedStyle(math).fontSize) * (outer.right - inner.left)) / inner.width;
  math.style.fontSize = `${Math.max(size - 0.1, LEAST_SIZE)}px`;
}

function fitAll() {
  document.querySelectorAll("main math").forEach(fitMath);
}

document.fonts.ready.then(fitAll);
window.addEventListener("resize", fitAll);
