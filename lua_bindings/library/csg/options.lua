--- Checks the options of a function that takes a table, as the functions of csgrun check theirs.
---
---   local options = require "csg.options"
---   function wheel(given)
---     local o = options("wheel", given, {
---       spokes = {5, min = 3, whole = true},           -- 5 when it is not given
---       radius = {type = "number", above = 0},         -- must be given
---       name   = {type = "string", optional = true},   -- nil when it is not given
---       finish = {"plain", choices = {"plain", "worn"}},
---       facets = {36, alias = "fn"},                   -- has two names
---     })
---
--- Gives a new table with the defaults filled in. What does not fit is an error at the place of the
--- call of `wheel`: an unknown name (with the nearest one that there is), a missing or a wrong value.

-- How many letters must be put in, taken out or replaced to get from one word to the other.
local function distance(a, b)
  local row = {}
  for j = 0, #b do row[j] = j end
  for i = 1, #a do
    local diagonal = row[0]
    row[0] = i
    for j = 1, #b do
      local same = a:byte(i) == b:byte(j)
      diagonal, row[j] = row[j],
        math.min(row[j] + 1, row[j - 1] + 1, diagonal + (same and 0 or 1))
    end
  end
  return row[#b]
end

local function did_you_mean(name, rules)
  local best, least = nil, #name // 3 + 1
  for known in pairs(rules) do
    local d = distance(name, known)
    if d <= least and (best == nil or d < least) then best, least = known, d end
  end
  if best then return " (did you mean '" .. best .. "'?)" end
  local names = {}
  for known in pairs(rules) do names[#names + 1] = known end
  table.sort(names)
  return "; it has " .. table.concat(names, ", ")
end

local function shown(value)
  if type(value) == "string" then return '"' .. value .. '"' end
  if type(value) == "table" then return "a table" end
  return tostring(value)
end

-- What is wrong with a value, or nil.
local function fault(value, rule)
  local wanted = rule.type or type(rule[1])
  if type(value) ~= wanted then
    return "must be a " .. wanted .. ", got " .. shown(value)
  end
  if wanted == "number" then
    if value ~= value or value == math.huge or value == -math.huge then
      return "must be a finite number, got " .. shown(value)
    end
    if rule.whole and value % 1 ~= 0 then return "must be a whole number, got " .. shown(value) end
    if rule.min and value < rule.min then
      return "must be at least " .. rule.min .. ", got " .. shown(value)
    end
    if rule.above and value <= rule.above then
      return "must be greater than " .. rule.above .. ", got " .. shown(value)
    end
    if rule.max and value > rule.max then
      return "must be at most " .. rule.max .. ", got " .. shown(value)
    end
  end
  if rule.choices then
    local names = {}
    for _, choice in pairs(rule.choices) do   -- pairs: also those behind a nil
      if choice == value then return nil end
      names[#names + 1] = shown(choice)
    end
    return "must be one of " .. table.concat(names, ", ") .. ", got " .. shown(value)
  end
end

--- `level`: whose call the error names; 1 is the caller of the function that checks.
-- Its own frame and the one before it (lua_bindings/shipped_calls.cpp) come on top of these.
---@param name string
---@param given table
---@param rules table
---@param level? integer
---@return table
return function(name, given, rules, level)
  level = (level or 1) + 3
  if type(given) ~= "table" then
    error(name .. ": wants a table of options, got " .. shown(given), level)
  end
  -- A rule that is none is a mistake of the function that checks, not of its caller.
  if type(rules) ~= "table" then
    error("csg.options: wants a table of rules, got " .. shown(rules), level - 1)
  end
  local aliases = {}
  for key, rule in pairs(rules) do
    if type(key) ~= "string" or type(rule) ~= "table" or (rule.type == nil and rule[1] == nil) then
      error("csg.options: " .. name .. ": the rule of " .. shown(key) ..
            " must be a table with a default or a type, as {5} or {type = \"number\"}", level - 1)
    end
    if rule.alias then aliases[rule.alias] = key end
  end
  for key in pairs(given) do
    if type(key) ~= "string" then
      error(name .. ": its options are named, got " .. shown(given[key]) .. " without a name", level)
    end
    if rules[key] == nil and aliases[key] == nil then
      error(name .. ": unknown option '" .. key .. "'" .. did_you_mean(key, rules), level)
    end
  end
  local result = {}
  for key, rule in pairs(rules) do
    local value = given[key]
    if rule.alias and given[rule.alias] ~= nil then
      if value ~= nil then
        error(name .. ": option '" .. key .. "' (or '" .. rule.alias .. "') is given twice", level)
      end
      value = given[rule.alias]
    end
    if value == nil then value = rule[1] end
    if value == nil then
      if not rule.optional then error(name .. ": option '" .. key .. "' is missing", level) end
    else
      local problem = fault(value, rule)
      if problem then error(name .. ": option '" .. key .. "' " .. problem, level) end
      result[key] = rule.whole and math.tointeger(value) or value   -- 40 / 2 is 20, not 20.0
    end
  end
  return result
end
